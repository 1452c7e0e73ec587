#pragma once

#include <optional>
#include <span>
#include <vector>

#include "protocol/spec/shadow_options.h"
#include "renderer/rays/light_source.h"
#include "renderer/rays/ray_packet.h"
#include "renderer/rays/trace.h"
#include "renderer/rays/tree.h"

namespace gnomon {

inline constexpr double kHalfUnit = 0x1p-24; ///< what rounding to a float changes at most, relative to the value

/// A point of a triangle as the start of rays.
struct Receiver {
  glm::dvec3 position{0};
  glm::dvec3 normal{0}; ///< of the triangle, or of shading; unit length, on the eye's side; zero = it has no area
  Triangle corners;     ///< of the triangle
  double unsure = 0;    ///< metres: of two surfaces as close as this, the ray that found it may have met either
  std::uint32_t instance = kNoSurface;
  std::uint32_t triangle = 0;
};

/// `eye`: of the camera that saw the point, relative to the anchor.
Receiver receiverAt(const TracedScene::Tree& tree, const glm::dvec3& eye, const SurfacePoint& point);

/// From a receiver towards a light, away from the side that the receiver turns its back to.
struct ShadowRay {
  Receiver from;
  glm::dvec3 direction{0}; ///< unit length
  double length = 0;       ///< metres to the light; infinite for directional ones
};

/// The same, as little as rays need until a caster comes near the planes that rounding moves.
struct RayToLight {
  const SurfacePoint* from = nullptr; ///< outlives the ray; of no surface: a place in the air
  WayToLight way;
};

/// Where Embree starts a point's rays, in the units of the tree: moved off the surface by what is lost at most when it
/// becomes a float (after Waechter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing
/// Gems, 2019). It only spares candidates: `meets` decides.
inline glm::vec3 startOf(const TracedScene::Tree& tree, const SurfacePoint& from) {
  const glm::dvec3 normal(from.normal);
  const double lost = 2 * kHalfUnit * glm::dot(glm::abs(normal), glm::abs(from.position));
  return glm::vec3((from.position + normal * lost) * tree.scale);
}

/// Up to kLanes rays, as Embree takes them and as its filters need them.
struct RaysToLight {
  RTCRayHit16 packet;
  std::array<RayToLight, kLanes> rays{};
  unsigned count = 0;

  RaysToLight() { setAllRays(packet.ray); }

  /// `start`: startOf(tree, from). REQUIRES: fewer than kLanes so far.
  void add(const TracedScene::Tree& tree, const SurfacePoint& from, const glm::vec3& start, const WayToLight& way) {
    setRay(packet.ray, count, start, way.direction, way.length * tree.scale);
    rays[count] = {&from, way};
    ++count;
  }
};

/// How an instance stops light.
enum class Opacity : std::uint8_t { none, full, byAlpha };

/// What throws shadows of a light.
struct Casters {
  const TracedScene::Tree& tree;
  glm::dvec3 eye{0};            ///< of the camera that sees the points, relative to the anchor
  std::vector<Opacity> opacity; ///< one an instance
  BlendedCasters blended = BlendedCasters::dither;
  double rounding = 0; ///< roundingIn(tree)
  /// Some let a part of the light through, which is counted once a caster: Embree 3.13 may ask about one twice where it
  /// follows rays that lie close together as one bundle.
  bool letThrough = false;

  RTCIntersectContextFlags closeRays() const {
    return letThrough ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : tree.closeRays();
  }
};

/// The share of the light that a candidate stops: 0 where it can't throw a shadow onto the ray's start.
double opacityOf(const Casters& casters, const RayToLight& ray, const Candidate& hit);

/// The share of the light that the material of a caster stops there. REQUIRES: Opacity::byAlpha.
double opacityAt(const Casters& casters, const PlacedTriangle& caster, const Barycentric& at);

/// The share of the light that comes through, for each ray; then there are none.
std::array<float, kLanes> sharesThrough(const Casters& casters, RaysToLight& rays);

/// Metres to the nearest caster that lets through less than half, for each ray; infinity where none does. Then there
/// are none.
std::array<float, kLanes> blockersOf(const Casters& casters, RaysToLight& rays);

/// The instance whose caster lies nearest to the light, of those that let through less than half, for each ray;
/// kNoSurface where none does. Then there are none.
std::array<std::uint32_t, kLanes> castersOf(const Casters& casters, RaysToLight& rays);

/// Metres: how far two planes and a point in one of them may lie apart and yet be the same. The vertices of both were
/// rounded when the file was written and when they were placed, which moves a plane by as much within its triangle
/// (Higham, "Accuracy and Stability of Numerical Algorithms", 2.1 and 3.1), and twice as much a triangle's length
/// beyond it. `largest`: of the coordinates of both triangles (Triangle::largest).
double roundingAlong(const glm::dvec3& normal, const glm::dvec3& largest);

/// Metres: half of what `meets` asks a caster to rise over a triangle, at least.
inline double leastRise(const glm::dvec3& normal, const Triangle& own) {
  return roundingAlong(normal, own.largest()) / 2;
}

/// Metres along the ray to where it meets a caster's triangle; nothing where the triangle can throw no shadow there:
/// it does not rise over the plane of the receiver, or the receiver's triangle lies in its plane, or it lies behind
/// the receiver's point, or beyond the light. What vertices and the camera's rays lose by being rounded decides for
/// light: neither a coplanar triangle nor a neighbour in a flat mesh casts.
std::optional<double> meets(const ShadowRay& ray, const Triangle& caster);

/// Metres: twice what `meets` puts down to rounding at most, of any two triangles of the scene and any eye.
double roundingIn(const TracedScene::Tree& tree);

/// True only where `meets` finds a distance: the caster's plane and the receiver's lie farther off each other than
/// rounding (roundingIn) moves either. Needs neither the receiver's triangle nor a unit normal. REQUIRES: the ray
/// starts on that triangle.
bool surelyMeets(const RayToLight& ray, const Triangle& caster, double rounding);

} // namespace gnomon
