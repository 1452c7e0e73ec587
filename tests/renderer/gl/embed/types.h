#pragma once
#ifdef __cplusplus
#include <glm/glm.hpp>
using glm::vec4;
#endif
struct Pair {
  vec4 first;
  vec4 second;
};
