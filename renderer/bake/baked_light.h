#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"

namespace gnomon {

/// One light's shadow on a static scene.
struct BakedLight {
  std::shared_ptr<const LightMapLayout> layout;
  LightMap map;
  double milliseconds = 0;                    ///< that baking it took
  EvenBlocks even{};                          ///< of the map
  std::vector<std::uint16_t> evenTriangles{}; ///< of the map and the layout's corners

  std::size_t bytes() const {
    return (map.shares.capacity() + evenTriangles.capacity()) * sizeof(std::uint16_t) + even.bytes();
  }
};

} // namespace gnomon
