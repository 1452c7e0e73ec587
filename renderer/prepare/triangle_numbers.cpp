#include "renderer/prepare/triangle_numbers.h"

#include <algorithm>

namespace gnomon {
TriangleNumbers::TriangleNumbers(const Scene& scene, const SceneView& view, const DrawList& list) {
  draws_.reserve(list.ranges.size());
  std::uint32_t number = 0;
  for (const DrawRange& range : list.ranges) {
    const Instance& instance = view.instances[range.instance];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    draws_.push_back({number, {range.instance, (range.firstIndex - primitive.firstIndex) / 3}});
    number += range.indexCount / 3;
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

} // namespace gnomon
