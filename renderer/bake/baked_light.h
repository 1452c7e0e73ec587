#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"

namespace gnomon {

/// The shadow of one light, or of an environment, on a static scene.
struct BakedLight {
  std::shared_ptr<const LightMapLayout> layout;
  LightMap map;                               ///< of an environment: of its red light
  double milliseconds = 0;                    ///< that baking it took
  EvenBlocks even{};                          ///< of the map
  std::vector<std::uint16_t> evenTriangles{}; ///< of the map and the layout's corners
  std::array<LightMap, 2> greenAndBlue{};     ///< of an environment alone, which has no even blocks and triangles

  std::size_t bytes() const {
    const std::size_t others = greenAndBlue[0].shares.capacity() + greenAndBlue[1].shares.capacity();
    return (map.shares.capacity() + others + evenTriangles.capacity()) * sizeof(std::uint16_t) + even.bytes();
  }
};

} // namespace gnomon
