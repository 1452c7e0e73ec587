#include "renderer/resolve/hybrid_maps.h"

#include <algorithm>

#include "protocol/spec/view_traits.h"
#include "renderer/shadow/tile_size.h"

namespace gnomon {
namespace {

/// What work takes where the processor draws, on the same cores that trace: nanoseconds on two of them with llvmpipe.
/// More cores or faster ones change all of it about alike.
struct Cost {
  double ray = 98; ///< for a pixel: its point and what it sees of the light
  double tileTriangle = 50;
  double outlines = 75; ///< for a triangle: whether its edges are outlines, and to mark them
  double tileTexel = 6;
  double verdict = 38; ///< for a pixel: to ask the map
  double unsure = 0.3; ///< share of the pixels that it leaves to rays
};
constexpr Cost kCost;

double texelsOf(const Light& light, const FrameSpec& spec) {
  const Shadow& shadow = *light.shadow;
  const int side = askedTileSize(shadow.size.value_or(ShadowSize::Large), shadow.importance, spec.atlas.baseSize,
                                 std::max(spec.width, spec.height));
  const int tiles = light.type == LightType::directional ? shadow.cascadeCount : light.type == LightType::point ? 6 : 1;
  return static_cast<double>(tiles) * side * side;
}

} // namespace

bool drawsHybridMap(const ResolvedFrame& frame, const SceneView& scene, int light, const RendererInfo& device) {
  const FrameSpec& spec = frame.spec;
  if (!device.software) return true;
  if (std::any_of(spec.views.begin(), spec.views.end(), [](View view) { return traitsOf(view).tiles; })) return true;
  const double pixels = static_cast<double>(spec.width) * spec.height;
  const double map = static_cast<double>(scene.triangles) * (kCost.tileTriangle + kCost.outlines) +
                     texelsOf((*spec.lights)[static_cast<std::size_t>(light)], spec) * kCost.tileTexel +
                     pixels * kCost.verdict;
  return map < pixels * (1 - kCost.unsure) * kCost.ray;
}

} // namespace gnomon
