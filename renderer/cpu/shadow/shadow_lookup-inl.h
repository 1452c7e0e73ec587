// Where a receiver lies in a light's tiles, and which of them serve it: shaders/common_shadow_lookup.glsl and
// common_shadow_choice.glsl, sixteen at a time.
#if defined(GNOMON_CPU_SHADOW_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADOW_LOOKUP_INL_H
#undef GNOMON_CPU_SHADOW_LOOKUP_INL_H
#else
#define GNOMON_CPU_SHADOW_LOOKUP_INL_H
#endif

#include "renderer/cpu/lanes/shared_functions-inl.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Where in the atlas receivers are looked up in one tile.
struct Lookup {
  Float3 coordinate; ///< atlas u v, depth less its bias
  Float divisor;     ///< metres from the light along the tile's axis; 1 for parallel light
  Mask inside;       ///< of what the tile covers; outside everything is lit
};

HWY_INLINE Float along(const glm::vec3& way, const Float3& v) {
  return mulAdd(v.x, way.x, mulAdd(v.y, way.y, v.z * way.z));
}

/// Where no bias has moved them: atlas u v and depth, times the divisor.
HWY_INLINE Float3 projected(const TileData& tile, const Float3& p) {
  return {along(tile.atlasFromRelative[0], p), along(tile.atlasFromRelative[1], p),
          along(tile.atlasFromRelative[2], p)};
}

HWY_INLINE Mask isWithin(const Float3& coordinate, const TileData& tile) {
  return (coordinate.x >= tile.lowest.x) & (coordinate.y >= tile.lowest.y) & (coordinate.x <= tile.highest.x) &
         (coordinate.y <= tile.highest.y);
}

/// Tiles have room for what is in view, not for how far it is lifted: what leaves one so is looked up at its rim, and
/// just behind the casters that are drawn with their depth clamped.
HWY_INLINE void keepLifted(const Mask& lifted, const TileData& tile, Float3& coordinate) {
  if (none(lifted)) return;
  coordinate.x = select(lifted, clamp(coordinate.x, tile.lowest.x, tile.highest.x), coordinate.x);
  coordinate.y = select(lifted, clamp(coordinate.y, tile.lowest.y, tile.highest.y), coordinate.y);
  coordinate.z = select(lifted, max(coordinate.z, 1e-6f), coordinate.z);
}

HWY_INLINE Lookup lookupIn(const LightData& light, const TileData& tile, const Receiver& receiver,
                           const Float3& toLight) {
  const Float3 p = movedReceiver(light, tile, receiver.relative, receiver.normal, toLight);
  Lookup at;
  at.coordinate = projected(tile, p);
  if (tile.perspective == 0u) {
    at.divisor = 1.0f;
    at.coordinate.z -= tile.depthBias + tile.depthBiasNear;
    keepLifted(receiver.smooth.lifted, tile, at.coordinate);
    at.inside = isWithin(at.coordinate, tile);
    return at;
  }
  const Float divisor = along(tile.atlasFromRelative[3], p);
  const Mask before = divisor > 0.0f;
  at.divisor = select(before, divisor, 1.0f);
  at.coordinate = at.coordinate / at.divisor;
  at.coordinate.z -= tile.depthBias + tile.depthBiasNear / (at.divisor * at.divisor);
  keepLifted(receiver.smooth.lifted, tile, at.coordinate);
  at.inside = before & isWithin(at.coordinate, tile);
  return at;
}

/// Texels of the tile.
HWY_INLINE Float2 placeIn(const ShadowMaps& maps, const TileMap& map, const Lookup& at) {
  const Float2 corner(static_cast<float>(map.rect.x), static_cast<float>(map.rect.y));
  return Float2(at.coordinate.x, at.coordinate.y) * Float2(maps.atlasTexels) - corner;
}

/// The first cascade that reaches as far as the view depth; none before the first one begins.
HWY_INLINE TileChoice chooseCascade(const ShadowMaps& maps, const shared::LightData& light, const Float& viewDepth) {
  const auto* tiles = maps.tiles.data() + light.firstTile;
  const int last = static_cast<int>(light.tileCount) - 1;
  Int index = 0;
  Float blendNear = tiles[0].blendNear;
  Float far = tiles[0].far;
  for (int i = 1; i <= last; ++i) {
    const Mask beyond = viewDepth > far;
    if (none(beyond)) break;
    index = select(beyond, Int(i), index);
    blendNear = select(beyond, tiles[i].blendNear, blendNear);
    far = select(beyond, tiles[i].far, far);
  }
  return cascadeChoice(light, index, blendNear, far, tiles[0].near, viewDepth);
}

/// The face that looks most nearly along the light's way to the point.
HWY_INLINE TileChoice chooseFace(const ShadowMaps& maps, const shared::LightData& light, const Float3& toLight) {
  Int best = 0;
  Float most = -2.0f;
  for (int i = 0; i < static_cast<int>(light.tileCount); ++i) {
    const Float way = -dot(Float3(maps.tiles[light.firstTile + i].axis), toLight);
    const Mask nearer = way > most;
    most = select(nearer, way, most);
    best = select(nearer, Int(i), best);
  }
  return {best, best, 0.0f, 0.0f, firstLanes(kLanes)};
}

/// Of a light that has tiles.
HWY_INLINE TileChoice chooseTile(const ShadowMaps& maps, const shared::LightData& light, const Receiver& receiver,
                                 const Float3& toLight) {
  if (light.type != GNOMON_DIRECTIONAL) return chooseFace(maps, light, toLight);
  return chooseCascade(maps, light, receiver.viewDepth);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
