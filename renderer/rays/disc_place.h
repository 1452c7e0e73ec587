#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

/// For loops over the lanes of packets.
namespace gnomon {

/// Of what loops over lanes decide: -1 or 0, as without branches they become vectors.
inline int when(bool holds) {
  return holds ? -1 : 0;
}
inline float select(int where, float a, float b) {
  return where != 0 ? a : b;
}

inline glm::vec3 select(int where, const glm::vec3& a, const glm::vec3& b) {
  return {select(where, a.x, b.x), select(where, a.y, b.y), select(where, a.z, b.z)};
}

/// A place of the unit square, in units of 2^-32, on the unit disc: as discFromSquare of light_source.cpp.
[[gnu::always_inline]] inline glm::vec2 discPlace(std::uint32_t x, std::uint32_t y) {
  const float px = static_cast<float>(static_cast<std::int32_t>(x ^ 0x80000000u)) * 0x1p-31f;
  const float py = static_cast<float>(static_cast<std::int32_t>(y ^ 0x80000000u)) * 0x1p-31f;
  const int wide = when(std::fabs(px) > std::fabs(py));
  const float radius = select(wide, px, py);
  const float ratio = select(wide, py, px) / select(when(radius == 0), 1.0f, radius);
  const float angle = 0.25f * std::numbers::pi_v<float> * ratio;
  const float z = angle * angle;
  const float along = radius * (1 + z * (-1.0f / 2 + z * (1.0f / 24 + z * (-1.0f / 720 + z * (1.0f / 40320)))));
  const float aside = radius * angle * (1 + z * (-1.0f / 6 + z * (1.0f / 120 + z * (-1.0f / 5040))));
  return {select(wide, along, aside), select(wide, aside, along)};
}

} // namespace gnomon
