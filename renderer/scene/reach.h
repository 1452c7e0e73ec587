#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <sstream>
#include <string>

#include "protocol/fields/ranges.h"
#include "renderer/core/aabb.h"
#include "renderer/scene/findings.h"

/// How far a scene may reach. The same for a file and for what an animation or a frame makes of it.
namespace gnomon {

/// Metres from the origin, along each axis; also the most that a node may stretch what hangs on it. Twice as far as
/// requests place anything. Every technique and view bears it (ExtremeFrames in tests/renderer); the square of an area
/// of such a scene, 2.6e38, is just finite in floats.
inline constexpr double kSceneReach = 2 * kPositionRange.max;

/// False for what is not finite.
inline bool isWithinReach(const glm::dvec3& v) {
  return std::abs(v.x) <= kSceneReach && std::abs(v.y) <= kSceneReach && std::abs(v.z) <= kSceneReach;
}

/// False for an empty box.
inline bool isWithinReach(const Aabb& box) {
  return isWithinReach(box.min) && isWithinReach(box.max);
}

inline bool isWithinReach(const glm::dmat4& worldFromNode) {
  for (int column = 0; column < 4; ++column) {
    if (!isWithinReach(glm::dvec3(worldFromNode[column]))) return false;
  }
  return true;
}

/// For a problem's `limit`.
inline std::string reachLimit() {
  std::ostringstream text;
  text << kSceneReach << " metres from the origin along each axis";
  return text.str();
}

/// For a problem's `actual`: node 3 "tree".
inline std::string nodeTitle(std::size_t node, const std::string& name) {
  return "node " + std::to_string(node) + (name.empty() ? "" : " " + inQuotes(name));
}

} // namespace gnomon
