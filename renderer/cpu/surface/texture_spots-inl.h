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

/// By the vertices' own coordinates of a set, 0 or 1.
HWY_INLINE TextureSpot spotOf(const Corners& corners, const Meeting& meeting, const MeetingSteps& steps, int set) {
  const std::size_t offset = set == 0 ? offsetof(VertexAttributes, uv0) : offsetof(VertexAttributes, uv1);
  return {corners.pair(offset, meeting), corners.moved(offset, steps.right), corners.moved(offset, steps.up)};
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
