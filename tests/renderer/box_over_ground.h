#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "tests/renderer/frame_fixture.h"

/// A box above a level ground, and what every pixel of its picture shows, in closed form.
namespace gnomon::testing {

struct BoxOverGround {
  double ground = 50;        ///< metres from the origin to each side, at y 0; node 0
  glm::dvec3 low{-1, 2, -1}; ///< of the box; node 1
  glm::dvec3 high{1, 4, 1};  ///< floats hold its numbers exactly, or nearly so

  GlbBuilder builder() const;
};

struct Sight {
  glm::dvec3 eye{3, 1.7, 6};
  glm::dvec3 target{0, 1, 0};
  double fovYDegrees = 50; ///< 0 = orthographic
  double height = 1;       ///< orthographic: metres
  double far = 4000;       ///< the same
  int width = 240;         ///< pixels
  int rows = 136;

  Json camera() const;
};

/// A sun where `way` leads towards it, or a lamp where it stands.
struct Source {
  glm::dvec3 at{0, 1, 0};
  bool lamp = false;
};

enum class Shown : std::uint8_t { other, lit, shadowed };

/// What each pixel's centre shows of the ground, first row on top.
std::vector<Shown> shownOf(const BoxOverGround& scene, const Sight& sight, const Source& source);

/// The same of a frame whose views are `shadow` and `ids`, as floats.
std::vector<Shown> shownOf(const Frame& frame);

/// Pixels that show the ground, and those of them in shadow.
struct GroundCounts {
  int ground = 0;
  int shadowed = 0;
};
GroundCounts countsOf(const std::vector<Shown>& shown);

/// Pixels at which two pictures differ.
int differing(const std::vector<Shown>& a, const std::vector<Shown>& b);

/// Renders `spec` with the sight and those two views, without antialiasing.
Frame shadowFrame(const ScenePtr& scene, const Sight& sight, Json spec);

} // namespace gnomon::testing
