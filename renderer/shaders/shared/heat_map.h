// The colors of numbers in pictures.

// Turbo, from 0 to 1 (Mikhailov, "Turbo, An Improved Rainbow Colormap for Visualization", Google 2019), by Du's
// polynomials of fifth degree. sRGB.
GNOMON_FUNCTION vec3 heat(Real at) {
  Real x = clamp(at, 0.0f, 1.0f);
  vec3 c = vec3(59.28637943f, 2.82956604f, 27.34824973f);
  c = c * x + vec3(-152.94239396f, 4.27729857f, -89.90310912f);
  c = c * x + vec3(132.13108234f, -14.18503333f, 110.36276771f);
  c = c * x + vec3(-42.66032258f, 4.84296658f, -60.58204836f);
  c = c * x + vec3(4.61539260f, 2.19418839f, 12.64194608f);
  return clamp(c * x + vec3(0.13572138f, 0.09140261f, 0.10667330f), 0.0f, 1.0f);
}
