#include "renderer/passes/tiles/tile_key.h"

namespace gnomon {
namespace {

template <class T>
void append(TileKey& key, const T& value) {
  const auto bytes = gl::bytesOfValue(value);
  key.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

} // namespace

// The tile's place counts: rasterizing elsewhere may round otherwise.
TileKey tileKey(const PassInputs& inputs, const ShadowTile& tile, const Light& light, const TileCasters& casters,
                int samples) {
  TileKey key;
  append(key, inputs.gpu.id);
  append(key, &inputs.view - inputs.scene.scenes.data());
  append(key, glm::mat4(tile.clipFromAnchored));
  append(key, tile.rect);
  append(key, samples);
  append(key, casters.use);
  append(key, light.shadow->blendedCasters);
  append(key, light.shadow->technique);
  append(key, tile.filter.type);
  append(key, tile.filter.size);
  append(key, tile.space.fit.radius);
  append(key, glm::vec2(tile.near, tile.far)); // moments are of depths between these
  key.append(casters.slots.begin(), casters.slots.end());
  return key;
}

} // namespace gnomon
