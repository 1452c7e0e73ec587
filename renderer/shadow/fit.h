#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/filter_kernel.h"

namespace gnomon {

/// Axes to look along a light: right and up span the shadow map, `direction` is where the light travels. Orthonormal;
/// right x up = -direction. Coordinates along these three axes are "light space" (Ls): x, y on the map, z growing away
/// from the light.
struct LightBasis {
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 direction{0, 0, -1};

  /// Rows right, up, direction: a pure turn, so that it takes both world and eye-relative points.
  glm::dmat3 lightFromWorld() const { return glm::transpose(glm::dmat3(right, up, direction)); }
};

/// Light space from eye-relative world space, with its origin there: a turn and a shift.
inline glm::dmat4 lightFromRelative(const LightBasis& basis, const glm::dvec3& origin) {
  const glm::dmat3 turn = basis.lightFromWorld();
  glm::dmat4 matrix(turn);
  matrix[3] = glm::dvec4(-(turn * origin), 1.0);
  return matrix;
}

/// The basis for a unit direction. It depends on nothing but the direction and turns as little as it, also at the
/// vertical. A tangent field on the sphere must spin somewhere; here that is around light shining up from a point 11
/// degrees below the horizon, where no sun is.
LightBasis lightBasis(const glm::dvec3& direction);

/// Metres from the eye to the farthest point of a slice: what a view sees between two depths.
double sliceReach(const CameraView& view, const DepthInterval& depths);

struct Sphere {
  glm::dvec3 center{0}; ///< relative to the eye
  double radius = 0;
};

/// The smallest sphere around a slice. Its radius depends on the lens and the depths, not on where the camera is or
/// looks.
Sphere sliceSphere(const CameraView& view, const DepthInterval& depths);

/// Where a tile's square of texels lies in light space. Parallel light: lengths across are metres. Light from a point:
/// they are metres for each metre of distance from the light along the tile's direction (tangents).
struct Fit {
  bool perspective = false; ///< the light comes from a point, the origin of light space
  glm::dvec2 lowest{0};     ///< corner of the whole rectangle, border included
  glm::dvec2 texelSize{0};  ///< the axes may differ
  double depthNear = 0;     ///< metres along the light where z is 0
  double depthExtent = 0;   ///< metres from z 0 to z 1
  double normalOffset = 0;  ///< metres, or metres for each metre of distance; see filter_kernel.h
  double radius = 0;        ///< of the filter, in lengths across: metres, or metres for each metre of distance
};

struct FitTarget {
  int tileSize = 0; ///< texels along a side, border included; at least kSmallestTile (tile_size.h)
  FilterKernel kernel;
  double reach = 0;                             ///< metres from the eye to the farthest receiver
  double magnitude = 0;                         ///< metres from the eye to the farthest thing drawn, see depthRounding
  double finestTangent = 16 * finestTexel(1.0); ///< light from a point: no texel is smaller
  std::optional<double> nearestCaster{};        ///< pcss: light space z; no caster's depth is clamped
  std::optional<double> manualOffset{}; ///< metres along the normal that were asked for, instead of the analytic ones
};

/// The widest radius of a filter as light from a point sees it, a tangent: nearer to the light, softness shrinks.
inline constexpr double kWidestTangent = 0.5;

/// What a stable fit sees of a view: its lens widened to the next of the steps that divide an octave in two, so that
/// texels keep their size while the lens zooms, but for the frame that passes a step. A picture that is not centred is
/// taken as one that lies on a grid of a sixteenth of the step.
CameraView steppedLens(const CameraView& view);

/// The tight fit: the tile without its border is the box of the receivers, room for their normal offset and for the
/// filter's radius, each axis with its own texel size. z runs from the receiver nearest the light to the farthest, and
/// the normal offset and the rounding beyond each; casters before z 0 must be drawn with their depth clamped.
Fit tightFit(const Aabb& receiversLs, const FitTarget& target);

/// The stable fit: the same square for every place and turn of the camera, moved over the world in steps of
/// `snapTexels` whole texels, counted from light space's origin. `eye` is the eye's place relative to that. Equal steps
/// give equal fits, to the bit.
Fit stableFit(const Sphere& sphere, const LightBasis& basis, const glm::dvec3& eye, int snapTexels,
              const FitTarget& target);

/// The box around receivers as light from a point sees them: x and y are tangents, cut to `tanHalf` on every side, z
/// metres along the tile's direction, of each no less than a thousandth of its end. `receiversLs`: relative to the
/// light, each in front of it.
Aabb tangentsOf(const std::vector<Aabb>& receiversLs, double tanHalf);

/// The fit for light from a point: the rectangle of directions in which the receivers lie (`seen`, from tangentsOf),
/// and room for their normal offset. z runs from the receiver nearest along the tile's direction to the farthest;
/// casters before z 0 must be drawn with their depth clamped.
Fit punctualFit(const Aabb& seen, double tanHalf, const FitTarget& target);

} // namespace gnomon
