// The alpha of a triangle, wherever it is seen from.
#if defined(GNOMON_CPU_ALPHA_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_ALPHA_INL_H
#undef GNOMON_CPU_ALPHA_INL_H
#else
#define GNOMON_CPU_ALPHA_INL_H
#endif

#include "renderer/cpu/surface/texture_spots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// A line through each place in clip space without its depth: x, y and w.
HWY_INLINE Sight sightThrough(const glm::vec2& size, const Float2& place) {
  Sight sight;
  sight.origin = Float3(0.0f);
  sight.way = {place.x * (2.0f / size.x) - 1.0f, place.y * (2.0f / size.y) - 1.0f, 1.0f};
  sight.stepX = {2.0f / size.x, 0, 0};
  sight.stepY = {0, 2.0f / size.y, 0};
  return sight;
}

/// What a hole is found by.
struct ReadAlpha {
  Float factor;         ///< of the material and its vertices
  Float texel{1.0f};    ///< of the texture
  Float halvings{0.0f}; ///< of the texture until a texel is as large as a place
  Float2 uv{Float(0.0f), Float(0.0f)};
};

/// `triangle`: of the instance's primitive; `size`: of what is rastered; `full`: read the texture itself, and not the
/// level whose texels are as large as pixels; `where`: the lanes that count.
HWY_INLINE ReadAlpha alphaOf(const FrameScene& scene, const Textures& textures, std::uint32_t instance,
                             const glm::mat4& clipFromLocal, const Int& triangle, const glm::vec2& size,
                             const Float2& place, bool full, const Mask& where) {
  const Slot& slot = scene.slots[scene.geometry.firstSlot[instance]];
  const Material& material = scene.scene.materials[static_cast<std::size_t>(slot.material)];
  const shared::MaterialData& data = scene.materials[static_cast<std::size_t>(slot.material)];
  ReadAlpha alpha{Float(data.baseColorFactor.w)};
  if (!hasHoles(material) || (!material.hasVertexColors && !material.baseColor)) return alpha;
  const Corners corners(scene, slot, triangle);
  const glm::mat4 columns = glm::transpose(clipFromLocal);
  const glm::vec4 rows[3] = {columns[0], columns[1], columns[3]};
  const Sight sight = sightThrough(size, place);
  const SeenTriangle seen = corners.seen(rows, sight);
  const Meeting meeting = meetingOf(sight, seen);
  if (material.hasVertexColors) alpha.factor *= corners.color(meeting).a;
  if (!material.baseColor || material.baseColor->image < 0) return alpha;
  const TextureUse& use = *material.baseColor;
  const SpotsOfSets spots = spotsOf(corners, meeting, stepsOf(sight, seen, meeting));
  const TextureSpot& seenSpot = spots.of[use.texCoord == 0 ? 0 : 1];
  const Float2 still{Float(0.0f), Float(0.0f)};
  const TextureSpot unmoved = full ? TextureSpot{seenSpot.uv, still, still} : seenSpot;
  const TextureSpot spot = use.transform ? moved(data, GNOMON_BASE_COLOR_UNIT, unmoved) : unmoved;
  const Texture& texture = textures.of(use.image, true);
  Taps taps;
  findTaps(texture, use, spot, where, taps);
  alpha.texel = sampled<kAlpha>(texture, taps).a;
  alpha.uv = spot.uv;
  alpha.halvings = levelOfDetail(texture, spot);
  return alpha;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
