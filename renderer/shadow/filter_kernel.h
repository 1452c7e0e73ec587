#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "protocol/fields/fields.h"
#include "protocol/spec/shadow_options.h"

namespace gnomon {

/// How a shadow map is read; by the numbers of shaders (GNOMON_FILTER_KERNEL ...).
enum class MapReadingKind {
  texels, ///< comparisons over a square of texels
  disc,   ///< comparisons over a disc of the world
  vsm,    ///< moments of blurred depths, as the next two
  evsm,
  msm,
  pcss ///< comparisons over a disc as wide as the penumbra of the casters that a search finds
};

inline constexpr std::array kMapReadingKinds{MapReadingKind::texels, MapReadingKind::disc, MapReadingKind::vsm,
                                             MapReadingKind::evsm,   MapReadingKind::msm,  MapReadingKind::pcss};
static_assert(!isEnumerator<static_cast<MapReadingKind>(kMapReadingKinds.size())>());

/// What a filter reads around a point: all that any stage uses of a filter.
struct FilterKernel {
  MapReadingKind kind = MapReadingKind::texels;
  int size = 1;           ///< texels along a side that are compared or blurred; 1 with a radius
  double radius = 0;      ///< metres around the point that are read besides; 0 = none
  double lightRadius = 0; ///< pcss: of the light, see radiusOf in renderer/core/light.h
  bool moments = false;   ///< the map's depths are blurred, not compared one by one
  /// Texels along an axis to the farthest texel centre that gets a weight. A comparison or a lookup of moments is
  /// bilinear: it weighs centres up to 1 away; `size` of them, a texel apart, reach (size + 1) / 2. With a radius a
  /// tap's own: 1.
  double reach = 1;
  /// Texels that a tile keeps on each side, so that a lookup at the edge of what it serves stays inside, however
  /// coordinates are rounded.
  int border = 2;
};

/// `lightRadius`: of the light; without one, pcss is a sharp comparison.
FilterKernel kernelOf(const Filter& filter, double lightRadius = 0);

/// Texels of error in a lookup's position, at most: see finestTexel.
inline constexpr double kTexelNoise = 1.0 / 32.0;

/// Texels that the bias of comparisons covers. They hold the receiver's plane against each texel at that texel's
/// centre, so the kernel's reach needs none. But a texel's depth belongs to its centre only to within the rasterizer's
/// grid (GL_SUBPIXEL_BITS >= 4: half a step is 1/32 texel), and a float position finds its texel to within kTexelNoise.
inline constexpr double kBiasReach = 1.0 / 32.0 + kTexelNoise;

/// The same of one filter: the bias of blurred depths covers the kernel's reach, too.
double biasReach(const FilterKernel& kernel);

/// Metres of normal offset that a blur's radius needs: to the corner of the square that it takes in.
double radiusOffset(const FilterKernel& kernel);

/// The smallest texel, metres, in which positions of this size (metres from the eye) can be found to within
/// kTexelNoise: interpolation and transform lose a few 2^-24 of the position.
double finestTexel(double magnitude);

/// Metres to move a receiver along its normal, to be multiplied by sin(angle between normal and light).
/// A plane inclined by that angle rises, towards the light, by up to tan(angle) * hypot(reach * texelSize) between a
/// lookup and a texel that it weighs; moved by N sin(angle) along its normal, the receiver stands
/// N sin(angle) / cos(angle) clear of the plane along the light, so N = reach * hypot(texelSize). With square texels
/// that is w (r + 0.5) sqrt(2). (Holbert, "Saying Goodbye to Shadow Acne", GDC 2011, made exact.)
double normalOffset(double reach, const glm::dvec2& texelSize);

/// The same for light from a point, for each metre of distance from it along the tile's direction; to be multiplied by
/// sin(angle between normal and that direction). `texelSize` is in metres a metre. Texels lie in planes across the
/// direction, and all that lies between the light and a point on the lit side of a plane is on that side: so the
/// argument above holds with the direction in the light's place. A moved receiver may be farther from the light by as
/// much as it moved, and its texels so much larger: N = c / (1 - c), c = reach * hypot(texelSize) + radiusOffset; the
/// latter in metres a metre, too.
double punctualNormalOffset(double reach, const glm::dvec2& texelSize, double radiusOffset = 0);

/// The metres along the normal that a manual bias asks for; none for an automatic one.
std::optional<double> manualOffset(const Bias& bias);

/// Metres along the light by which map and receiver may disagree about one surface through rounding alone.
/// `magnitude` bounds the distance from the eye to what is drawn. z is a sum of three float products and an offset, and
/// each of its inputs is rounded: 5 roundings of 2^-24 on magnitudes that add up to at most twice `magnitude`, once for
/// the map and once for the receiver. (Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 3.1.)
double depthRounding(double magnitude);

/// The same in z units of a tile of parallel light, with the quantum of a 32-bit float depth.
double depthBias(double magnitude, double depthExtent);

/// What a 32-bit float depth and its interpolation lose in a tile of light from a point, z units.
double punctualDepthQuantum();

} // namespace gnomon
