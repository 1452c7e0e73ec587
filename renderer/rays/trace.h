#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/rays/traced_scene.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

/// Exact answers for single points, many at a time, on all cores. Any thread.
namespace gnomon {

struct Medium;

/// Inputs of the ray queries of one frame. All of it outlives the calls.
struct TraceInput {
  const TracedScene& traced;
  const CameraView& camera;
  int width = 0; ///< of the frame, pixels
  int height = 0;
  std::span<const Light> lights;          ///< effective
  std::span<const NodeSwitches> nodes;    ///< one a node of the file; empty = every node has the defaults
  std::span<const Medium* const> media{}; ///< volumes: they dim light that comes from everywhere, and no other
};

inline NodeSwitches switchesOf(const TraceInput& input, std::uint32_t instance) {
  return switchesOf(input.nodes, input.traced.view().instances[instance].node);
}

/// Whether an instance shows the shadows of a light.
inline bool receivesFrom(const TraceInput& input, const Light& light, std::uint32_t instance) {
  const Scene& scene = input.traced.scene();
  const int material = materialOf(scene, input.traced.view().instances[instance]);
  return receivesFrom(light, switchesOf(input, instance), scene.materials[static_cast<std::size_t>(material)]);
}

/// One an instance: 1 where its node's switches pass.
template <class Pass>
std::vector<std::uint8_t> instancesWhere(const TraceInput& input, Pass pass) {
  std::vector<std::uint8_t> marks(input.traced.view().instances.size());
  for (std::uint32_t i = 0; i < marks.size(); ++i) marks[i] = pass(switchesOf(input, i)) ? 1 : 0;
  return marks;
}

/// Where a camera ray first meets a surface that the camera sees: visible nodes, faces that are not culled, alpha that
/// is not masked away.
struct SurfacePoint {
  glm::dvec3 position{0};              ///< relative to anchorOf(view)
  glm::vec3 normal{0};                 ///< of the triangle itself, on the eye's side; unit length
  std::uint32_t instance = kNoSurface; ///< index into SceneView::instances; kNoSurface = the ray meets nothing
  std::uint32_t triangle = 0;          ///< of its primitive
  bool smooth = false; ///< it stands off the triangle, on the surface that shading shows; so does the normal
};

/// Sixteen places of a picture and the triangle that was drawn at each. Fastest where they lie close together.
struct DrawnPlaces {
  static constexpr std::size_t kCount = 16;
  float x[kCount] = {}; ///< as firstHits takes them
  float y[kCount] = {};
  PlacedTriangle shown[kCount] = {}; ///< kNoSurface = none
};

/// Where each lies in its triangle: the weights of its second and third corner, 0..1. Any numbers where none is shown.
struct DrawnWeights {
  float u[DrawnPlaces::kCount];
  float v[DrawnPlaces::kCount];
};

/// What each shows, as floats see it. Any numbers, NaN too, where none is shown.
struct DrawnSurfaces {
  float relative[3]
                [DrawnPlaces::kCount];  ///< the point, from the eye; in units of the scene's own that the camera knows
  float normal[3][DrawnPlaces::kCount]; ///< of the triangle, on the eye's side; unit length
};

struct DrawnView;

/// What a frame's camera sees. Made once, asked for any number of places; any thread. What the input refers to outlives
/// it.
class TracedCamera {
 public:
  explicit TracedCamera(const TraceInput& input);

  /// firstHits, one a place, on the calling thread. REQUIRES: as many points as places.
  void firstHits(std::span<const glm::vec2> places, std::span<SurfacePoint> points) const;

  DrawnWeights weights(const DrawnPlaces& places) const;

  DrawnSurfaces surfaces(const DrawnPlaces& places) const;

 private:
  TraceInput input_;
  std::shared_ptr<const DrawnView> view_;
  std::vector<std::uint8_t> visible_; ///< one an instance
};

/// The first hits of the camera rays through `places`: pixels from the picture's upper left corner, so that the centre
/// of the first pixel is 0.5 0.5. Masks are read as the picture shows them: in the middle of the pixel.
std::vector<SurfacePoint> firstHits(const TraceInput& input, std::span<const glm::vec2> places);

/// Where the camera rays through `places` cross the triangles that are known to show there, one a place; moved to the
/// triangle's nearest side where rounding has the ray pass it. Where none shows, there is no surface.
std::vector<SurfacePoint> pointsOn(const TraceInput& input, std::span<const glm::vec2> places,
                                   std::span<const PlacedTriangle> triangles);

/// The same, on the calling thread. REQUIRES: as many of each as places.
void pointsOn(const TraceInput& input, std::span<const glm::vec2> places, std::span<const PlacedTriangle> triangles,
              std::span<SurfacePoint> points);

/// The point where rays from `point` to light `light` start: on the surface that shading shows, where
/// Shadow::terminator asks for that and the point's own triangle is turned away from it, or from part of it; else the
/// point.
SurfacePoint shadedPoint(const TraceInput& input, int light, const SurfacePoint& point);

/// Whether light `light` is able to reach each point: the surface shares a layer with it, faces it, also by the normal
/// that it is shaded by, and lies in its range and its cone.
std::vector<std::uint8_t> facesLight(const TraceInput& input, int light, std::span<const SurfacePoint> points);

/// Share of light `light` that each point sees, 0..1, whatever the shadow's strength: 1 where there is no surface,
/// where the surface receives no shadow or the light throws none; else 0 where it is turned away from the light, and 1
/// where it faces it out of its range or its cone. `samples`
/// rays for a light that has a size, stratified, the same for the same point in every call; one ray for one that has
/// none. Blended casters let 1 - alpha through, or all or nothing by `blendedCasters`.
std::vector<float> lightVisibility(const TraceInput& input, int light, std::span<const SurfacePoint> points,
                                   int samples);

/// A rectangle of a picture's places that all show one triangle.
struct DrawnBlock {
  glm::vec2 first{0}, last{0}; ///< places in opposite corners, as firstHits takes them
  PlacedTriangle shown;        ///< kNoSurface = none
};

/// What a whole block sees of a light.
enum class LightAcross { lit, turnedAway, unsure };

struct Lanes;
struct LightSamples;

/// One light of a frame as rays meet it. Made once, asked for any number of points; any thread. What the input refers
/// to outlives it.
class TracedLight {
 public:
  /// `rays`: how many are sent to a light that has a size from a drawn place, at most.
  TracedLight(const TraceInput& input, int light, int rays = 1);
  TracedLight(TracedLight&&) noexcept;
  ~TracedLight();

  /// lightVisibility, a share a point, on the calling thread; `turnedAway`, unless it is empty: 1 where the share is 0
  /// because the surface does not face the light. REQUIRES: as many of each as points.
  void visibility(std::span<const SurfacePoint> points, int samples, std::span<float> shares,
                  std::span<std::uint8_t> turnedAway = {}) const;

  /// The same of what drawn places show, as pointsOn finds it: a share and a mark for each of the sixteen. To a light
  /// that has a size go the rays from number `first` up to `last` of the pixel's own, which have been even all over the
  /// light since number 0, and lie between those of the pixels around (Interleaved). REQUIRES: `last` <= rays.
  void visibility(const DrawnPlaces& places, std::uint32_t first, std::uint32_t last, std::span<float> shares,
                  std::span<std::uint8_t> turnedAway) const;

  /// What visibility would say of every point of a block: all of the light, or none because the surface does not face
  /// it. Unsure where something lies between, or may.
  LightAcross across(const DrawnBlock& block) const;

  /// Whether frames asked about this light before: then it is found out what whole triangles see of it, some of them in
  /// each frame, and kept for later ones.
  bool knowsTriangles() const;

  /// The same of every point that the camera sees of a triangle. Unsure where that is not known yet.
  LightAcross across(const PlacedTriangle& shown) const;

  /// A point of a triangle: `weights`, those of its second and third corner. Its normal is on the light's side.
  SurfacePoint pointFacing(const PlacedTriangle& triangle, const glm::dvec2& weights) const;

  /// The share of the middle of the light that casters let through to places in the air, which turn their back to no
  /// light; relative to anchorOf(view). Whether the light shines there is not asked. On the calling thread. REQUIRES:
  /// as many of each.
  void airVisibility(std::span<const glm::dvec3> places, std::span<float> shares) const;

  /// blockerDistances, one a point, on the calling thread. REQUIRES: as many of each as points.
  void blockerDistances(std::span<const SurfacePoint> points, std::span<float> distances) const;

  /// casterInstances, one a point, on the calling thread. REQUIRES: as many instances as points.
  void casters(std::span<const SurfacePoint> points, std::span<std::uint32_t> instances) const;

  bool hasSize() const; ///< several rays go to it from a point

  struct State; ///< for the files of this folder

 private:
  void visibility(std::span<const SurfacePoint> points, const LightSamples& samples, std::span<float> shares,
                  std::span<std::uint8_t> turnedAway) const;
  /// Of the places of some lanes, by their exact points.
  void exactVisibility(const DrawnPlaces& places, const Lanes& lanes, const LightSamples& samples,
                       std::span<float> shares, std::span<std::uint8_t> turnedAway) const;
  std::unique_ptr<const State> state_;
};

/// Metres from each point to what hides the light's middle from it, the nearest; infinity where nothing does.
std::vector<float> blockerDistances(const TraceInput& input, int light, std::span<const SurfacePoint> points);

/// The instance that hides the light's middle from each point: of several the one nearest to the light, as in a shadow
/// map; of blended ones those that stop more than half. What is turned away from the light and hidden by nothing else
/// hides the light from itself. kNoSurface where nothing does, and where no light of it could arrive: out of its range
/// or cone, on what receives no shadow of it.
std::vector<std::uint32_t> casterInstances(const TraceInput& input, int light, std::span<const SurfacePoint> points);

} // namespace gnomon
