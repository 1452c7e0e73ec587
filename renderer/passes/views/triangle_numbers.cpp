#include "renderer/passes/views/triangle_numbers.h"

#include <algorithm>

namespace gnomon {
namespace {

/// A copy of its instance for each draw. Floats are exact for these numbers: there are no more than
/// kLimits.maxTriangles.
gl::Buffer instancePerDraw(const PassInputs& inputs, DrawList& list) {
  std::vector<shared::InstanceData> instances;
  instances.reserve(list.commands.size());
  std::uint32_t number = 0;
  for (gl::DrawCommand& command : list.commands) {
    shared::InstanceData instance = inputs.geometry.instances[command.baseInstance];
    instance.normalFromLocal[1].w = static_cast<float>(number);
    command.baseInstance = static_cast<std::uint32_t>(instances.size());
    instances.push_back(instance);
    number += command.indexCount / 3;
  }
  return gl::Buffer(gl::bytesOf(instances), "numbered instances");
}

} // namespace

TriangleNumbers::TriangleNumbers(const Scene& scene, const SceneView& view, const DrawList& list) {
  draws_.reserve(list.commands.size());
  std::uint32_t number = 0;
  for (const gl::DrawCommand& command : list.commands) {
    const Instance& instance = view.instances[command.baseInstance];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    draws_.push_back({number, {command.baseInstance, (command.firstIndex - primitive.firstIndex) / 3}});
    number += command.indexCount / 3;
  }
}

std::vector<PlacedTriangle> TriangleNumbers::of(std::span<const std::uint32_t> numbers) const {
  std::vector<PlacedTriangle> triangles(numbers.size());
  std::size_t draw = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == kNoNumber) continue;
    const std::uint32_t number = numbers[i];
    const bool sameDraw =
        number >= draws_[draw].firstNumber && (draw + 1 == draws_.size() || number < draws_[draw + 1].firstNumber);
    if (!sameDraw) {
      const auto after = std::upper_bound(draws_.begin(), draws_.end(), number,
                                          [](std::uint32_t n, const Draw& d) { return n < d.firstNumber; });
      draw = static_cast<std::size_t>(after - draws_.begin()) - 1;
    }
    const Draw& of = draws_[draw];
    triangles[i] = {of.first.instance, of.first.triangle + (number - of.firstNumber)};
  }
  return triangles;
}

NumberedInstances::NumberedInstances(const PassInputs& inputs, DrawList& list)
    : instances_(instancePerDraw(inputs, list)), vertices_(sceneVertices(inputs.gpu, instances_)) {}

} // namespace gnomon
