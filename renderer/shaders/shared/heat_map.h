// The colors of numbers in pictures, one definition for C++ and GLSL.
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
#define GNOMON_FUNCTION inline
namespace gnomon::shared {
using glm::clamp;
using glm::vec3;
#else
#define GNOMON_FUNCTION
#endif

// Turbo, from 0 to 1 (Mikhailov, "Turbo, An Improved Rainbow Colormap for Visualization", Google 2019), by Du's
// polynomials of fifth degree. sRGB.
GNOMON_FUNCTION vec3 heat(float at) {
  float x = clamp(at, 0.0f, 1.0f);
  vec3 c = vec3(59.28637943f, 2.82956604f, 27.34824973f);
  c = c * x + vec3(-152.94239396f, 4.27729857f, -89.90310912f);
  c = c * x + vec3(132.13108234f, -14.18503333f, 110.36276771f);
  c = c * x + vec3(-42.66032258f, 4.84296658f, -60.58204836f);
  c = c * x + vec3(4.61539260f, 2.19418839f, 12.64194608f);
  return clamp(c * x + vec3(0.13572138f, 0.09140261f, 0.10667330f), 0.0f, 1.0f);
}

#ifdef __cplusplus
} // namespace gnomon::shared
#endif
