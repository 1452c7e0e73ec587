#pragma once

#include <cstdint>
#include <vector>

#include "renderer/prepare/draw_list.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The triangles of a draw list are numbered through, so that a pixel can say in one word which of them it shows.
inline constexpr std::uint32_t kNoNumber = 0xffffffffu;

/// Which triangle a number stands for.
class TriangleNumbers {
 public:
  TriangleNumbers() = default;
  TriangleNumbers(const Scene& scene, const SceneView& view, const DrawList& list);

  /// Fastest when consecutive numbers share a draw. REQUIRES: numbers of the list, or
  /// kNoNumber.
  std::vector<PlacedTriangle> of(std::span<const std::uint32_t> numbers) const;

 private:
  struct Draw {
    std::uint32_t firstNumber = 0;
    PlacedTriangle first;
  };
  std::vector<Draw> draws_; ///< by their first number
};

} // namespace gnomon
