// Textures read at sixteen places, as OpenGL reads them.
#if defined(GNOMON_CPU_SAMPLING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SAMPLING_INL_H
#undef GNOMON_CPU_SAMPLING_INL_H
#else
#define GNOMON_CPU_SAMPLING_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/cpu/surface/textures.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Linear, 0..1.
struct Texel {
  Float3 rgb{0.0f};
  Float a{0.0f};
};

/// Of a texel its alpha alone.
struct TexelAlpha {
  Float a{0.0f};
};

/// Where a texture is read, and how that moves as the picture's place moves by a pixel to the right and up.
struct TextureSpot {
  Float2 uv, right, up;
};

/// sRGB decoded, from 0..255. Of all bytes within 0.02 of the step to the next.
HWY_INLINE Float decoded(const Float& byte) {
  const Float x = byte * (1.0f / 255.0f);
  Float y = mulAdd(x, 0.0855919495f, -0.303306013f);
  y = mulAdd(x, y, 0.663709462f);
  y = mulAdd(x, y, 0.520611703f);
  y = mulAdd(x, y, 0.0325727798f);
  y = mulAdd(x, y, 0.000924181892f);
  return select(byte > 10.5f, y, x * (1.0f / 12.92f));
}

/// One axis of a texture: the two texels that a place lies between, and the second one's share.
struct Axis {
  Int first, second;
  Float share;
};

HWY_INLINE Int wrapped(const Int& texel, Wrap wrap, int size) {
  if (wrap != Wrap::repeat) return min(max(texel, Int(0)), Int(size - 1));
  return select(texel < Int(0), Int(size - 1), select(texel >= Int(size), Int(0), texel));
}

HWY_INLINE Axis axisOf(const Float& coordinate, Wrap wrap, int size, bool nearest) {
  Float within = coordinate;
  if (wrap == Wrap::repeat) within = fract(coordinate);
  // There and back; beyond both ends lies the end texel again.
  if (wrap == Wrap::mirroredRepeat) within = 1.0f - abs(coordinate - 2.0f * floor(coordinate * 0.5f) - 1.0f);
  if (wrap == Wrap::clampToEdge) within = clamp(coordinate, 0.0f, 1.0f);
  const Float place = within * static_cast<float>(size) - (nearest ? 0.0f : 0.5f);
  const Float below = floor(place);
  Axis axis;
  axis.first = wrapped(truncated(below), wrap, size);
  axis.second = nearest ? axis.first : wrapped(truncated(below) + Int(1), wrap, size);
  axis.share = nearest ? Float(0.0f) : place - below;
  return axis;
}

/// Adds the texels of a level at those places, times `weight`; of bytes.
HWY_INLINE void addTexels(const TextureLevel& level, bool srgb, const Int& at, const Float& weight, Texel& sum) {
  const Int bits = gather(level.texels, at);
  const Int byte(255);
  Float r = toFloat(bits & byte);
  Float g = toFloat(shiftRight<8>(bits) & byte);
  Float b = toFloat(shiftRight<16>(bits) & byte);
  if (srgb) {
    r = decoded(r);
    g = decoded(g);
    b = decoded(b);
  }
  sum.rgb.x = mulAdd(r, weight, sum.rgb.x);
  sum.rgb.y = mulAdd(g, weight, sum.rgb.y);
  sum.rgb.z = mulAdd(b, weight, sum.rgb.z);
  sum.a = mulAdd(toFloat(shiftRightUnsigned<24>(bits)), weight, sum.a);
}

HWY_INLINE void addTexels(const TextureLevel& level, bool, const Int& at, const Float& weight, TexelAlpha& sum) {
  sum.a = mulAdd(toFloat(shiftRightUnsigned<24>(gather(level.texels, at))), weight, sum.a);
}

template <class Sum>
HWY_INLINE void addLevel(const TextureLevel& level, bool srgb, const TextureUse& use, bool nearest, const Float2& uv,
                         const Float& weight, Sum& sum) {
  const Axis x = axisOf(uv.x, use.wrapS, level.width, nearest);
  const Axis y = axisOf(uv.y, use.wrapT, level.height, nearest);
  const Int first = y.first * Int(level.width);
  if (nearest) return addTexels(level, srgb, first + x.first, weight, sum);
  const Int second = y.second * Int(level.width);
  const Float upper = weight * (1.0f - y.share), lower = weight * y.share;
  addTexels(level, srgb, first + x.first, upper * (1.0f - x.share), sum);
  addTexels(level, srgb, first + x.second, upper * x.share, sum);
  addTexels(level, srgb, second + x.first, lower * (1.0f - x.share), sum);
  addTexels(level, srgb, second + x.second, lower * x.share, sum);
}

/// How often the texture is halved until a texel is as large as a pixel; below 0 it is shown larger than it is.
HWY_INLINE Float levelOfDetail(const TextureLevel& base, const TextureSpot& spot) {
  const Float2 size(Float(static_cast<float>(base.width)), Float(static_cast<float>(base.height)));
  const Float2 right = spot.right * size, up = spot.up * size;
  const Float squared = max(dot(right, right), dot(up, up));
  return 0.5f * log2(clamp(squared, 1e-20f, 1e20f));
}

inline bool nearestTexel(MinFilter filter) {
  return filter == MinFilter::nearest || filter == MinFilter::nearestMipmapLinear ||
         filter == MinFilter::nearestMipmapNearest;
}

/// The texture's bytes at each place. Lanes differ in their levels by few, so all lanes read one level at a time.
template <class Sum>
HWY_INLINE Sum bytesAt(const Pyramid& texture, const TextureUse& use, const TextureSpot& spot, const Mask& where) {
  // Not a number compares as false: what a triangle without area leads to is some texel.
  const Mask placed = (abs(spot.uv.x) < 1e6f) & (abs(spot.uv.y) < 1e6f);
  const Float2 uv = select(placed, spot.uv, Float2(Float(0.0f)));
  const float last = static_cast<float>(texture.levels.size() - 1);
  const Float detail = levelOfDetail(texture.levels[0], spot);
  const Mask larger = detail <= 0.0f;
  const bool mipmapped = use.minFilter != MinFilter::linear && use.minFilter != MinFilter::nearest;
  const bool blended =
      use.minFilter == MinFilter::linearMipmapLinear || use.minFilter == MinFilter::nearestMipmapLinear;
  Float level(0.0f); // and where levels are blended, the share of the next
  if (mipmapped) level = clamp(blended ? detail : ceil(detail - 0.5f), 0.0f, last);

  Sum sum{};
  const auto add = [&](const TextureLevel& from, bool nearest, const Mask& lanes, const Float& weight) HWY_ATTR {
    addLevel(from, texture.srgb, use, nearest, uv, select(lanes, weight, Float(0.0f)), sum);
  };
  // What is shown larger and smaller than it is differ where their filters do.
  const bool sameFilter = use.nearest == nearestTexel(use.minFilter);
  if (!sameFilter && any(larger & where)) add(texture.levels[0], use.nearest, larger, 1.0f);
  const Mask levelled = sameFilter ? where : andNot(larger, where);
  const Float lowest = floor(level);
  const Float highest = blended ? ceil(level) : level;
  for (std::size_t i = 0; i < texture.levels.size(); ++i) {
    const Float number(static_cast<float>(i));
    const Mask reads = levelled & (lowest <= number) & (highest >= number);
    if (none(reads)) continue;
    add(texture.levels[i], nearestTexel(use.minFilter), reads, 1.0f - abs(level - number));
  }
  return sum;
}

inline constexpr float kOfByte = 1.0f / 255.0f;

/// The texture at each place.
inline HWY_NOINLINE Texel sampled(const Pyramid& texture, const TextureUse& use, const TextureSpot& spot,
                                  const Mask& where) {
  const Texel bytes = bytesAt<Texel>(texture, use, spot, where);
  return {bytes.rgb * Float(texture.srgb ? 1.0f : kOfByte), bytes.a * kOfByte};
}

/// Its alpha, to the bit.
inline HWY_NOINLINE Float sampledAlpha(const Pyramid& texture, const TextureUse& use, const TextureSpot& spot,
                                       const Mask& where) {
  return bytesAt<TexelAlpha>(texture, use, spot, where).a * kOfByte;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
