// A surface that shows nothing but the shadows on it: what is behind it, times the share of the light that arrives. Its
// light is that of a white matt surface in its place, as luminance over pi.
struct CaughtLight {
  Real all;  // without shadows
  Real lost; // of that, to shadows
};

GNOMON_FUNCTION CaughtLight caughtLight(Real all, Real lost) {
  CaughtLight caught;
  caught.all = all;
  caught.lost = lost;
  return caught;
}

// Of one light. `arriving`: irradiance on what faces it; `left`: the share of each color that shadows leave.
GNOMON_FUNCTION CaughtLight caughtFrom(vec3 normal, vec3 toLight, vec3 arriving, vec3 left) {
  Real facing = max(dot(normal, toLight), 0.0f) * (1.0f / kPi);
  return caughtLight(luminance(arriving) * facing, luminance(arriving * (vec3(1.0f) - left)) * facing);
}

// Of the surroundings. `arriving`: their irradiance over pi; `left`: the share of them that the scene does not hide.
GNOMON_FUNCTION CaughtLight caughtAround(vec3 arriving, vec3 left) {
  return caughtLight(luminance(arriving), luminance(arriving * (vec3(1.0f) - left)));
}

// `alpha` is straight, as in pictures: over any background the result is `behind` over that background, times the share
// of the light that arrives. Where nothing could arrive, nothing is lost.
GNOMON_FUNCTION SeenLight seenThroughCatcher(SeenLight behind, CaughtLight caught) {
  Real lost = select(caught.all > 0.0f, min(caught.lost / max(caught.all, 1e-30f), 1.0f), Real(0.0f));
  Real alpha = behind.alpha + (1.0f - behind.alpha) * lost;
  Real share = select(lost > 0.0f, behind.alpha * (1.0f - lost) / max(alpha, 1e-30f), Real(1.0f));
  return seenLight(behind.radiance * share, behind.color * share, alpha);
}
