#include "renderer/shadow/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/shadow/penumbra_reach.h"

namespace gnomon {
namespace {

constexpr double kNearShare = 1e-3; ///< of the far end of depths from a point, where they begin at least

int innerTexels(const FitTarget& target) {
  return target.tileSize - 2 * target.kernel.border;
}

/// A receiver's plane is held against texels beside it, where it may lie nearer to the light than any receiver. This
/// much nearer, metres or metres a metre, it still has a depth of its own: up to a tangent of 2 to the light.
double planeRoom(const FitTarget& target, const glm::dvec2& texelSize) {
  return target.kernel.moments ? 0.0 : 2.0 * normalOffset(target.kernel.reach, texelSize);
}

/// Room for a receiver that is moved along its normal, for rounding, and for the quantum of the depth.
double depthMargin(double depthLength, double moved, double magnitude) {
  return moved + 2.0 * depthRounding(magnitude) + 0x1p-20 * depthLength;
}

/// How far before the nearest receiver the depths of a blurred map begin: a caster farther off is flattened onto that
/// plane, and must be clear of what it shades, for moments can't separate close depths.
double clearance(const FitTarget& target, double depthLength, double width) {
  return target.kernel.moments ? std::max(depthLength, 0.25 * width) : 0.0;
}

/// Where a tile's depths begin that must hold these: pcss needs the depths of casters unclamped.
double beginOfDepths(double near, const FitTarget& target) {
  if (!target.nearestCaster) return near;
  return std::min(near, *target.nearestCaster - 2.0 * depthRounding(target.magnitude));
}

/// The normal offset N of a box of `extent` metres on `inner` texels that must have room for N on every side:
/// N = c hypot(extent.x + 2 N, extent.y + 2 N) + constant with c = reach / inner, solved for N.
double offsetWithRoom(const glm::dvec2& extent, double reach, int inner, double constant) {
  const double c2 = reach * reach / (static_cast<double>(inner) * inner);
  const double a = 1.0 - 8.0 * c2;
  const double halfB = constant + 2.0 * c2 * (extent.x + extent.y);
  const double squares = c2 * (extent.x * extent.x + extent.y * extent.y) - constant * constant;
  return (halfB + std::sqrt(halfB * halfB + a * squares)) / a;
}

/// The frame that a light straight from `pole` gets; the opposite of `pole` is the direction where the field spins.
struct PoleFrame {
  glm::dvec3 right, up, pole;
};

PoleFrame poleFrame() {
  const double azimuth = glm::radians(37.3);
  const double elevation = glm::radians(11.0);
  const glm::dvec3 pole(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        -std::cos(azimuth) * std::cos(elevation));
  const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
  return {right, glm::cross(pole, right), pole};
}

} // namespace

double sliceReach(const CameraView& view, const DepthInterval& depths) {
  const glm::dvec2 farthest = glm::abs(view.center) + view.halfSize;
  const double fromAxis = std::hypot(farthest.x, farthest.y);
  if (view.perspective) return depths.far * std::hypot(1.0, fromAxis);
  return std::hypot(std::max(std::abs(depths.near), std::abs(depths.far)), fromAxis);
}

// The centre lies on the way m through the picture's middle, at depth c. With a corner's way m + k the squares of the
// distances to the farthest near and far corners are, where n <= c <= f,
//   (c - n)^2 mm + 2 (c - n) n p + n^2 kk   and   (f - c)^2 mm + 2 (f - c) f p + f^2 kk,
// p being the greatest |mk|: 0 where the picture is centred. They are the same at the c below; where that lies beyond
// the far plane, the far corners alone decide and the centre is in their plane, and so it is in a slice of no length,
// whose c is not a number.
Sphere sliceSphere(const CameraView& view, const DepthInterval& depths) {
  const auto [near, far] = depths;
  const double t = std::hypot(view.halfSize.x, view.halfSize.y);
  if (!view.perspective) return {view.forward * (0.5 * (near + far)), std::hypot(0.5 * (far - near), t)};
  const double mm = 1.0 + glm::dot(view.center, view.center);
  const double pOverLength = glm::dot(glm::abs(view.center), view.halfSize) / (far - near);
  const double meeting =
      (0.5 * (near + far) * (mm + t * t) + pOverLength * (near * near + far * far)) / (mm + pOverLength * (near + far));
  const double center = std::min(far, meeting);
  const glm::dvec2 aside = glm::abs(view.center) * (far - center) + view.halfSize * far;
  return {wayToMiddle(view) * center, std::hypot(far - center, std::hypot(aside.x, aside.y))};
}

CameraView steppedLens(const CameraView& view) {
  constexpr double kAtStep = 1e-9; // a lens that is as wide as a step but for rounding is not wider
  const double t = glm::length(view.halfSize);
  const double step = std::exp2(0.5 * std::ceil(2.0 * std::log2(t) - kAtStep));
  CameraView stepped = view;
  if (view.center == glm::dvec2(0.0)) {
    stepped.halfSize = glm::dvec2(step * std::sqrt(0.5)); // of a centred picture only the length counts
    return stepped;
  }
  const double grid = step / 16.0;
  stepped.center = glm::round(view.center / grid) * grid;
  stepped.halfSize = glm::ceil(view.halfSize * (step / t) / grid + 0.5) * grid;
  return stepped;
}

Fit tightFit(const Aabb& receiversLs, const FitTarget& target) {
  const int inner = innerTexels(target);
  const glm::dvec3 length = receiversLs.max - receiversLs.min;
  const glm::dvec2 extent = glm::max(glm::dvec2(length), glm::dvec2(finestTexel(target.reach) * inner));

  const double reach = biasReach(target.kernel);
  const glm::dvec2 read = extent + 2.0 * target.kernel.radius;
  Fit fit;
  fit.radius = target.kernel.radius;
  const double room = target.manualOffset.value_or(offsetWithRoom(read, reach, inner, radiusOffset(target.kernel)));
  fit.texelSize = (read + 2.0 * room) / static_cast<double>(inner);
  fit.normalOffset = target.manualOffset.value_or(normalOffset(reach, fit.texelSize) + radiusOffset(target.kernel));
  fit.lowest = glm::dvec2(receiversLs.center()) - fit.texelSize * (0.5 * target.tileSize);
  const double margin = depthMargin(length.z, fit.normalOffset + planeRoom(target, fit.texelSize), target.magnitude);
  const double clear = clearance(target, length.z, std::max(read.x, read.y));
  const double near = receiversLs.min.z - margin - clear;
  fit.depthNear = beginOfDepths(near, target);
  fit.depthExtent = length.z + 2.0 * margin + clear + (near - fit.depthNear);
  return fit;
}

Fit stableFit(const Sphere& sphere, const LightBasis& basis, const glm::dvec3& eye, int snapTexels,
              const FitTarget& target) {
  const int inner = innerTexels(target);
  const double reach = biasReach(target.kernel);
  // inner * texel >= 2 radii (the sphere's and the filter's) + 2 normal offsets + the step, of which rounding takes up
  // to half on either side
  const double fixed = target.kernel.radius + target.manualOffset.value_or(radiusOffset(target.kernel));
  const double texels = inner - snapTexels - (target.manualOffset ? 0.0 : 2.0 * std::sqrt(2.0) * reach);
  const double texel = std::max(2.0 * (sphere.radius + fixed) / texels, finestTexel(target.reach));
  const double step = snapTexels * texel;

  const glm::dvec3 snapped = glm::round(basis.lightFromWorld() * (eye + sphere.center) / step) * step;

  Fit fit;
  fit.radius = target.kernel.radius;
  fit.texelSize = glm::dvec2(texel);
  fit.normalOffset = target.manualOffset.value_or(normalOffset(reach, fit.texelSize) + radiusOffset(target.kernel));
  fit.lowest = glm::dvec2(snapped) - fit.texelSize * (0.5 * target.tileSize);
  const double depthLength = 2.0 * sphere.radius + step;
  const double margin = depthMargin(depthLength, fit.normalOffset + planeRoom(target, fit.texelSize), target.magnitude);
  const double clear = clearance(target, depthLength, depthLength);
  const double near = snapped.z - 0.5 * depthLength - margin - clear;
  fit.depthNear = beginOfDepths(near, target);
  fit.depthExtent = depthLength + 2.0 * margin + clear + (near - fit.depthNear);
  return fit;
}

Aabb tangentsOf(const std::vector<Aabb>& receiversLs, double tanHalf) {
  Aabb seen;
  for (const Aabb& piece : receiversLs) {
    const double near = std::max(piece.min.z, kNearShare * piece.max.z);
    const glm::dvec2 low = glm::min(glm::dvec2(piece.min) / near, glm::dvec2(piece.min) / piece.max.z);
    const glm::dvec2 high = glm::max(glm::dvec2(piece.max) / near, glm::dvec2(piece.max) / piece.max.z);
    seen.add(Aabb{glm::dvec3(glm::clamp(low, -tanHalf, tanHalf), near),
                  glm::dvec3(glm::clamp(high, -tanHalf, tanHalf), piece.max.z)});
  }
  return seen;
}

Fit punctualFit(const Aabb& seen, double tanHalf, const FitTarget& target) {
  const int inner = innerTexels(target);
  const double reach = biasReach(target.kernel);
  const glm::dvec2 extent = glm::max(glm::dvec2(seen.max - seen.min), glm::dvec2(target.finestTangent * inner));

  // What a length in metres spans, seen from the light, at the nearest receiver; a blur is one for the whole tile.
  const auto tangent = [&](double metres) { return std::min(metres / seen.min.z, kWidestTangent); };
  const double blurred = std::sqrt(seen.min.z * seen.max.z);
  Fit fit;
  fit.perspective = true;
  fit.radius =
      target.kernel.moments ? std::min(target.kernel.radius / blurred, kWidestTangent) : tangent(target.kernel.radius);
  if (target.nearestCaster) {
    const double nearest = std::max(*target.nearestCaster, kNearShare * seen.max.z);
    fit.radius = std::min(penumbraTangent(nearest, seen.max.z, target.kernel.lightRadius), kWidestTangent);
  }
  const double offset = target.kernel.moments ? std::sqrt(2.0) * fit.radius : 0.0;
  glm::dvec2 room(0.0);
  for (int turn = 0; turn < 16; ++turn) {
    fit.texelSize = (extent + 2.0 * (room + fit.radius)) / static_cast<double>(inner);
    fit.normalOffset =
        target.manualOffset ? tangent(*target.manualOffset) : punctualNormalOffset(reach, fit.texelSize, offset);
    // Moved by N a metre, a direction's tangent changes by up to N (1 + tangent) / (1 - N).
    const double moved = std::min(fit.normalOffset, 0.5);
    room = glm::dvec2(moved * (1.0 + tanHalf) / (1.0 - moved));
  }
  fit.lowest = glm::dvec2(seen.center()) - fit.texelSize * (0.5 * target.tileSize);
  const double margin = depthMargin(seen.max.z - seen.min.z, fit.normalOffset * seen.max.z, target.magnitude);
  const double far = seen.max.z + margin;
  const double near = seen.min.z * (1.0 - std::min(fit.normalOffset + planeRoom(target, fit.texelSize), 0.5)) -
                      2.0 * depthRounding(target.magnitude);
  const double clear = target.kernel.moments ? std::max(0.5 * near, far - near) : 0.0;
  fit.depthNear = std::max(beginOfDepths(near - clear, target), kNearShare * far);
  fit.depthExtent = far - fit.depthNear;
  return fit;
}

// The pole's frame carried to the light along a great circle (Frisvad, "Building an Orthonormal Basis from a 3D Unit
// Vector Without Normalization", 2012). Frisvad's 1 / (1 + z) cancels near z = -1 (Duff et al., "Building an
// Orthonormal Basis, Revisited", 2017); there (1 - z) / (x^2 + y^2), the same number on the unit sphere, does not.
LightBasis lightBasis(const glm::dvec3& direction) {
  const PoleFrame frame = poleFrame();
  const glm::dvec3 towards = -glm::normalize(direction);
  const double x = glm::dot(towards, frame.right);
  const double y = glm::dot(towards, frame.up);
  const double z = glm::dot(towards, frame.pole);
  const double lateral = x * x + y * y;

  glm::dvec3 right(1, 0, 0);
  glm::dvec3 up(0, -1, 0);
  if (z > 0.0 || lateral > 1e-300) {
    const double s = z > 0.0 ? 1.0 / (1.0 + z) : (1.0 - z) / lateral;
    right = {1.0 - x * x * s, -x * y * s, -x};
    up = {-x * y * s, 1.0 - y * y * s, -y};
  }
  const glm::dmat3 worldFromPole(frame.right, frame.up, frame.pole);
  return {worldFromPole * right, worldFromPole * up, -towards};
}

} // namespace gnomon
