#pragma once

#include <memory>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"

namespace gnomon {

/// One light's shadow on a scene that stands still.
struct BakedLight {
  std::shared_ptr<const LightMapLayout> layout;
  LightMap map;
  double milliseconds = 0; ///< that baking it took

  std::size_t bytes() const { return map.shares.capacity() * sizeof(map.shares[0]); }
};

} // namespace gnomon
