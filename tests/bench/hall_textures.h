#pragma once

#include <glm/glm.hpp>

#include "protocol/base/bytes.h"

namespace gnomon::bench {

/// Texels along a side of each texture.
inline constexpr int kTextureSide = 1024;

enum class Stuff { stone, bricks, cloth, leaves };

/// The textures of one material, encoded: what gives a renderer as much to decode and to read as photographs do.
struct MaterialTextures {
  Bytes baseColor; ///< JPEG; of leaves a PNG whose alpha cuts them out
  Bytes roughness; ///< JPEG: metal in blue, roughness in green
  Bytes normal;    ///< JPEG
};

/// `seed`: others look otherwise. The same each time.
MaterialTextures texturesOf(Stuff stuff, const glm::vec3& color, unsigned seed);

} // namespace gnomon::bench
