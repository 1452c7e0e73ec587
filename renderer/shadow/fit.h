#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/bias.h"
#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/splits.h"

namespace gnomon {

/// Metres from the eye to the farthest point of a slice: what a view sees between two depths.
double sliceReach(const CameraView& view, const DepthInterval& depths);

struct Sphere {
  glm::dvec3 center{0}; ///< relative to the eye
  double radius = 0;
};

/// The smallest sphere around a slice. Its radius depends on the lens and the depths, not on where the camera stands or
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
  double normalOffset = 0;  ///< metres, or metres for each metre of distance; see bias.h
  double radius = 0;        ///< of the filter, in lengths across: metres, or metres for each metre of distance
};

struct FitTarget {
  int tileSize = 0; ///< texels along a side, border included; at least kSmallestTile (tile_size.h)
  FilterKernel kernel;
  double reach = 0;                     ///< metres from the eye to the farthest receiver
  double magnitude = 0;                 ///< metres from the eye to the farthest thing drawn, see depthRounding
  std::optional<double> manualOffset{}; ///< metres along the normal that were asked for, instead of the analytic ones
};

/// The widest radius of a filter as light from a point sees it, a tangent: nearer to the light, softness shrinks.
inline constexpr double kWidestTangent = 0.5;

/// The tight fit: the tile without its border is the box of the receivers, room for their normal offset and for the
/// filter's radius, each axis with its own texel size. z runs from the receiver nearest the light to the farthest, and
/// the normal offset and the rounding beyond each; casters before z 0 must be drawn with their depth clamped.
Fit tightFit(const Aabb& receiversLs, const FitTarget& target);

/// The stable fit: the same square for every place and turn of the camera, moved over the world in steps of
/// `snapTexels` whole texels, counted from light space's origin. `eye` is the eye's place relative to that. Equal steps
/// give equal fits, to the bit.
Fit stableFit(const Sphere& sphere, const LightBasis& basis, const glm::dvec3& eye, int snapTexels,
              const FitTarget& target);

/// The fit for light from a point: the rectangle of directions in which `receiversLs` lie (each in front of the light,
/// relative to it), cut to `tanHalf` on every side, and room for their normal offset. z runs from the receiver nearest
/// along the tile's direction to the farthest; casters before z 0 must be drawn with their depth clamped.
Fit punctualFit(const std::vector<Aabb>& receiversLs, double tanHalf, const FitTarget& target);

} // namespace gnomon
