#include "renderer/frame/check_baked.h"

#include <algorithm>
#include <span>

#include "renderer/core/collect.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

std::span<const glm::vec3> verticesOf(const Scene& scene, const Instance& instance) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  return std::span(scene.positions).subspan(primitive.baseVertex, primitive.vertexCount);
}

/// A node that an animation moves from its rest pose, hides, or whose mesh it deforms; -1 = there is
/// none.
int movedNode(const Scene& without, const Scene& with, int index) {
  const std::vector<Instance>& still = without.scenes[static_cast<std::size_t>(index)].instances;
  const std::vector<Instance>& moved = with.scenes[static_cast<std::size_t>(index)].instances;
  const bool deformed = without.positions != with.positions;
  const auto same = [&](const Instance& a, const Instance& b) {
    if (a.node != b.node || a.primitive != b.primitive || a.copy != b.copy) return false;
    if (a.worldFromLocal != b.worldFromLocal || a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max)
      return false;
    return !deformed || std::ranges::equal(verticesOf(without, a), verticesOf(with, b));
  };
  const auto [a, b] = std::mismatch(still.begin(), still.end(), moved.begin(), moved.end(), same);
  if (b != moved.end()) return b->node;
  return a == still.end() ? -1 : a->node;
}

std::string nameOf(const Scene& scene, int node) {
  const std::string& name = scene.nodes[static_cast<std::size_t>(node)].name;
  return name.empty() ? std::to_string(node) : "\"" + name + "\"";
}

} // namespace

Status checkBaked(const ScenePtr& loaded, const ScenePtr& posed, const FrameSpec& asked, const ResolvedFrame& frame) {
  std::vector<int> lights = layeredLights(frame);
  std::erase_if(lights, [&](int light) { return !techniqueOf(frame, light).baked; });
  if (lights.empty()) return Done{};
  const auto still = posedScene(loaded, {.nodes = asked.nodes});
  if (!still) return still.problems();
  const int node = movedNode(**still, *posed, frame.scene);
  if (node < 0) return Done{};
  ProblemList problems;
  for (const int light : lights) {
    collect({{ProblemCode::unsupportedFeature, shadowPlace(asked, light) + "/technique",
              "A light map holds shadows of static nodes, but this pose moves node " + nameOf(*loaded, node) + ".",
              "another technique, or no animation", "lightMap"}},
            problems);
  }
  return std::move(problems).take();
}

} // namespace gnomon
