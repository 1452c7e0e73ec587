// Which of a light's tiles serve a receiver: shaders/common_shadow_choice.glsl, sixteen at a time.
#if defined(GNOMON_CPU_TILE_CHOICE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_TILE_CHOICE_INL_H
#undef GNOMON_CPU_TILE_CHOICE_INL_H
#else
#define GNOMON_CPU_TILE_CHOICE_INL_H
#endif

#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

struct TileChoice {
  Int first;    ///< among the light's tiles
  Int second;   ///< blended in; = first where there is none
  Float blend;  ///< share of the second
  Float fade;   ///< share of "lit" at the far end of a manual range
  Mask covered; ///< lanes that some tile serves
};

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
  const Float zone = select(far > blendNear, smoothstep(blendNear, far, viewDepth), 0.0f);
  const Mask isLast = index == Int(last);
  const Mask blended = andNot(isLast, zone > 0.0f);
  TileChoice choice;
  choice.first = index;
  choice.second = select(blended, index + Int(1), index);
  choice.blend = select(blended, zone, 0.0f);
  choice.fade = 0.0f;
  choice.covered = viewDepth >= tiles[0].near;
  if (light.fadesOut != 0u) {
    choice.fade = select(isLast, zone, 0.0f);
    choice.covered = choice.covered & ((!isLast) | (viewDepth <= far));
  }
  return choice;
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
