// Where sixteen places of a triangle read its textures.
#if defined(GNOMON_CPU_TEXTURE_SPOTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_TEXTURE_SPOTS_INL_H
#undef GNOMON_CPU_TEXTURE_SPOTS_INL_H
#else
#define GNOMON_CPU_TEXTURE_SPOTS_INL_H
#endif

#include <cstddef>

#include "renderer/cpu/surface/sampling-inl.h"
#include "renderer/cpu/surface/vertices-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Whether two textures of one size are read at the same places in the same way.
inline bool readAlike(const TextureUse& a, const TextureUse& b) {
  return a.texCoord == b.texCoord && a.wrapS == b.wrapS && a.wrapT == b.wrapT && a.nearest == b.nearest &&
         a.minFilter == b.minFilter && a.transform == b.transform;
}

/// By the vertices' own coordinates, of both sets.
struct SpotsOfSets {
  TextureSpot of[2];
};
HWY_INLINE SpotsOfSets spotsOf(const Corners& corners, const Meeting& meeting, const MeetingSteps& steps) {
  static_assert(offsetof(VertexAttributes, uv1) == offsetof(VertexAttributes, uv0) + 2 * sizeof(float));
  const Corners::Fields fields = corners.fields(offsetof(VertexAttributes, uv0));
  SpotsOfSets spots;
  for (std::size_t set = 0; set < 2; ++set) {
    const Field& u = fields.of[2 * set];
    const Field& v = fields.of[2 * set + 1];
    spots.of[set] = {{u.at(meeting), v.at(meeting)},
                     {u.moved(steps.right), v.moved(steps.right)},
                     {u.moved(steps.up), v.moved(steps.up)}};
  }
  return spots;
}

/// KHR_texture_transform of one of a material's textures (GNOMON_..._UNIT).
HWY_INLINE TextureSpot moved(const shared::MaterialData& material, std::size_t unit, const TextureSpot& spot) {
  const glm::vec4& axes = material.uvAxes[unit];
  const auto turn = [&](const Float2& v)
                        HWY_ATTR { return Float2(v.x * axes.x + v.y * axes.z, v.x * axes.y + v.y * axes.w); };
  return {turn(spot.uv) + Float2(glm::vec2(material.uvOffsets[unit])), turn(spot.right), turn(spot.up)};
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
