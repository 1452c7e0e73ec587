#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "renderer/core/aabb.h"
#include "renderer/rays/ray_packet.h"
#include "renderer/rays/trace.h"
#include "renderer/rays/tree.h"

/// Camera rays and triangles in double precision, kLanes at a time and a coordinate after the other, so that loops over
/// the lanes become vectors. Metres, relative to the scene's anchor.
namespace gnomon {

/// The camera for many rays: the line through a place of the picture begins at origin + ndc * spread and leads along
/// middle + ndc * slope, a step of one metre of view depth.
struct Sight {
  glm::dvec3 origin{0};
  glm::dvec3 middle{0}, right{0}, up{0}; ///< middle: wayToMiddle
  glm::dvec2 size{1};                    ///< of the picture, pixels
  glm::dvec2 spread{0}, slope{0};
};

Sight sightOf(const TraceInput& input);

struct Places {
  float x[kLanes], y[kLanes]; ///< pixels from the upper left corner
};

struct Lines {
  double origin[3][kLanes];
  double direction[3][kLanes];
};

/// The line through each place, from the eye; orthographic: from beside it.
void setLines(const Sight& sight, const Places& places, Lines& lines);

/// What is left of lines between two view depths and in a box.
struct Stretches {
  double length[kLanes]; ///< view depth from where it begins to the far end; infinite where nothing ends it
  int meets[kLanes];     ///< -1, or 0 where nothing is left
};

/// Moves the lines' origins to where they come between `near` and `far`, and close to what they look for in `box`: so
/// the distance of the eye takes nothing from its precision.
void enter(const Aabb& box, double near, double far, Lines& lines, Stretches& stretches);

/// The corners of kLanes triangles, a coordinate after the other, in the tree's units.
struct TriangleLanes {
  float a[3][kLanes], b[3][kLanes], c[3][kLanes];

  /// `shown`: a triangle of the tree, or none: then all corners are the anchor.
  void setTriangle(const TracedScene::Tree& tree, unsigned lane, const PlacedTriangle& shown) {
    const auto corners =
        shown.instance == kNoSurface ? std::array{glm::vec3(0), glm::vec3(0), glm::vec3(0)} : tree.corners(shown);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      a[axis][lane] = corners[0][axis];
      b[axis][lane] = corners[1][axis];
      c[axis][lane] = corners[2][axis];
    }
  }
};

struct Crossings : TriangleLanes {
  /// Where the line crosses, as crossing() finds it; before: where it runs along the plane.
  double u[kLanes], v[kLanes];
  double facing[kLanes]; ///< more than 0 where the line leads along the triangle's normal
  double position[3][kLanes];
  float normal[3][kLanes]; ///< unit length, against the line; zero where the triangle has no area

  SurfacePoint point(unsigned lane, const PlacedTriangle& hit) const {
    return {{position[0][lane], position[1][lane], position[2][lane]},
            {normal[0][lane], normal[1][lane], normal[2][lane]},
            hit.instance,
            hit.triangle};
  }
};

/// Crosses each line with its triangle. `scale`: of the tree.
void cross(const Lines& lines, double scale, Crossings& crossings);

/// Where the lines through up to kLanes places cross what shows there; no surface = nothing. Lines along a triangle's
/// plane: its middle.
Crossings crossingsOf(const Sight& sight, const TracedScene::Tree& tree, const Places& places,
                      std::span<const PlacedTriangle> shown);

} // namespace gnomon
