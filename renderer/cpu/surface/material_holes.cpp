#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/cpu/surface/material_holes.cpp" // NOLINT: Highway includes this file again
#include "renderer/cpu/surface/material_holes.h"

#include <algorithm>
#include <bit>
#include <hwy/foreach_target.h>
#include <iterator>

#include "renderer/cpu/surface/alpha-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Of the places that are `asked` for those where alpha times `opacity` is at least `least`, a number a place.
unsigned filledPlaces(const HolesInput& input, const HoledPlaces& places, float opacity, const float* least,
                      unsigned asked) {
  const std::uint32_t first = input.scene.geometry.firstSlot[places.instance] * kClusterTriangles;
  const Mask where = maskOf(asked);
  // The others have a triangle of the instance, too.
  const auto any = static_cast<std::int32_t>(places.number[std::countr_zero(asked)]);
  const Int triangle = select(where, load(places.number), Int(any)) - Int(static_cast<std::int32_t>(first));
  const ReadAlpha alpha =
      alphaOf(input.scene, input.textures, places.instance, input.clipFromLocal[places.instance], triangle,
              glm::vec2(input.size), Float2(toFloat(load(places.x)) + 0.5f, toFloat(load(places.y)) + 0.5f),
              input.byLight, where);
  const Slot& slot = input.scene.slots[input.scene.geometry.firstSlot[places.instance]];
  const MaskCoverage* mask =
      input.masks != nullptr ? (*input.masks)[static_cast<std::size_t>(slot.material)].get() : nullptr;
  unsigned filled = asked & bitsOf(alpha.factor * opacity * alpha.texel >= load(least));
  if (mask == nullptr) return filled;
  const unsigned smaller = asked & bitsOf(alpha.halvings > 0.0f);
  if (smaller == 0) return filled;
  alignas(64) float factor[kLanes], texel[kLanes], halvings[kLanes], u[kLanes], v[kLanes];
  store(alpha.factor, factor);
  store(alpha.texel, texel);
  store(alpha.halvings, halvings);
  store(alpha.uv.x, u);
  store(alpha.uv.y, v);
  for (unsigned left = smaller; left != 0; left &= left - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(left));
    const bool keeps = mask->keeps({{u[i], v[i]}, halvings[i], texel[i]}, factor[i], least[i]);
    filled = keeps ? filled | 1u << i : filled & ~(1u << i);
  }
  return filled;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {

GNOMON_EXPORT_KERNEL(filledPlaces);

/// A well mixed number. (Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020: pcg.)
std::uint32_t hashOf(std::uint32_t seed) {
  const std::uint32_t state = seed * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

/// The pattern of what is dithered at a texel of the atlas, 0..1: see common_alpha_mask.glsl. `surface`: hash of the
/// triangle.
float patternAt(const glm::uvec2& p, std::uint32_t surface, bool counterClockwise) {
  const std::uint32_t x = p.x ^ p.y;
  std::uint32_t rank = (x & 1u) << 3 | (p.y & 1u) << 2 | (x & 2u) | (p.y & 2u) >> 1;
  if (!counterClockwise) rank ^= ((rank & 1u) * 12u) ^ ((rank & 2u) << 2);
  rank ^= hashOf((p.x >> 3) + hashOf((p.y >> 3) + surface)) >> 28;
  return (static_cast<float>(rank) + 0.5f) / 16.0f;
}

/// The triangle's last vertex and its node: which triangle it is, whatever else is drawn.
std::uint32_t surfaceHash(const FrameScene& scene, std::uint32_t number) {
  const Slot& slot = scene.slots[number / kClusterTriangles];
  const std::size_t last = slot.firstIndex + 3 * std::size_t{number % kClusterTriangles} + 2;
  const std::uint32_t vertex = scene.scene.indices[last] + slot.baseVertex;
  return hashOf(vertex + hashOf(static_cast<std::uint32_t>(scene.geometry.instances[slot.instance].node)));
}

} // namespace

unsigned MaterialHoles::filled(const HoledPlaces& places, unsigned asked) const {
  const FrameScene& scene = input_.scene;
  const auto number = static_cast<std::size_t>(scene.slots[scene.geometry.firstSlot[places.instance]].material);
  const Material& material = scene.scene.materials[number];
  const bool dithers = input_.dithers && material.lightOpacity;
  alignas(64) float least[HoledPlaces::kAsked] = {};
  if (dithers) {
    for (unsigned left = asked; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const glm::uvec2 texel(input_.corner + glm::ivec2(places.x[i], places.y[i]));
      least[i] = patternAt(texel, surfaceHash(scene, places.number[i]), (places.counterClockwise >> i & 1u) != 0);
    }
  } else {
    std::fill(std::begin(least), std::end(least), material.cutoff.value_or(0.0f));
  }
  return GNOMON_KERNEL(filledPlaces)(input_, places, dithers ? *material.lightOpacity : 1.0f, least, asked);
}

} // namespace gnomon::cpu
#endif
