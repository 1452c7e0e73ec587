#include "renderer/cpu/frame_scene.h"

#include <algorithm>

#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {

// Every slot but an instance's last is full, so that a scene within the limits never runs out of numbers.
static_assert(kLimits.maxInstances + kLimits.maxTriangles / kClusterTriangles < kNoNumber / kClusterTriangles);

namespace {

std::vector<Slot> slotsOf(const Scene& scene, const SceneView& view, const FrameGeometry& geometry) {
  std::vector<Slot> slots;
  slots.reserve(geometry.slotCount());
  for (std::uint32_t i = 0; i < view.instances.size(); ++i) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(view.instances[i].primitive)];
    const int material = materialOf(scene, view.instances[i]);
    for (std::uint32_t first = 0; slots.size() < geometry.firstSlot[i + 1]; first += kClusterTriangles) {
      slots.push_back({i, primitive.firstIndex + 3 * first,
                       std::min(kClusterTriangles, primitive.indexCount / 3 - first), primitive.baseVertex, material});
    }
  }
  return slots;
}

std::vector<shared::MaterialData> materialsOf(const Scene& scene) {
  std::vector<shared::MaterialData> materials;
  materials.reserve(scene.materials.size());
  std::transform(scene.materials.begin(), scene.materials.end(), std::back_inserter(materials), materialData);
  return materials;
}

SmoothAsked smoothAsked(const ResolvedFrame& frame) {
  constexpr std::size_t kMostSuns = 4; // more take longer to ask about than to be ready for
  SmoothAsked smooth;
  bool anywhere = false;
  for (const Light& light : frame.spec.lights.value_or(std::vector<Light>{})) {
    const Shadow shadow = light.shadow.value_or(Shadow{});
    const bool asks = shadow.enabled && shadow.terminator == Terminator::smooth && !traitsOf(shadow.technique).layered;
    if (!asks) continue;
    smooth.asked = true;
    anywhere = anywhere || !traitsOf(light.type).parallel || smooth.suns.size() == kMostSuns;
    if (anywhere) continue;
    smooth.suns.emplace_back(glm::vec3(-directionOf(light)),
                             static_cast<float>(std::max(radiusOf(light), 1e-4) + 1e-5));
  }
  if (anywhere) smooth.suns.clear();
  return smooth;
}

} // namespace

FrameScene frameScene(const Scene& scene, const SceneView& view, const FrameGeometry& geometry,
                      const ResolvedFrame& frame) {
  return {scene,
          view,
          geometry,
          slotsOf(scene, view, geometry),
          instanceData(geometry),
          materialsOf(scene),
          frameData(frame),
          frame.spec.width,
          frame.spec.height,
          smoothAsked(frame)};
}

} // namespace gnomon::cpu
