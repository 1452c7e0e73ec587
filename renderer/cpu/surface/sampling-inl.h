// Textures read at sixteen places, as OpenGL reads them.
#if defined(GNOMON_CPU_SAMPLING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SAMPLING_INL_H
#undef GNOMON_CPU_SAMPLING_INL_H
#else
#define GNOMON_CPU_SAMPLING_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/scene/scene.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Linear, 0..1.
struct Texel {
  Float3 rgb{0.0f};
  Float a{0.0f};
};

/// What is read of a texel, a bit each: the others stay 0.
enum Channels : unsigned { kRed = 1, kGreen = 2, kBlue = 4, kAlpha = 8, kColor = 7, kAllChannels = 15 };

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

/// The texels of a level that each place lies between, and their weights.
struct LevelTaps {
  std::size_t level;
  std::size_t count; ///< four, or the nearest alone
  bool adjacent;     ///< the second lies behind the first, the last behind the third
  Int at[4];
  Float weight[4];
};

/// What is read of a texture. It is the same for one of the same size that is read in the same way.
struct Taps {
  static constexpr std::size_t kMost = 34; ///< each size once, and the largest by another filter
  std::size_t count = 0;
  std::size_t finest = 0; ///< the largest level among them
  LevelTaps of[kMost];
};

HWY_INLINE void setTaps(const TextureUse& use, int width, int height, bool nearest, const Float2& uv,
                        const Float& weight, LevelTaps& taps) {
  const Axis x = axisOf(uv.x, use.wrapS, width, nearest);
  const Axis y = axisOf(uv.y, use.wrapT, height, nearest);
  taps.count = nearest ? 1 : 4;
  taps.adjacent = !nearest && all(x.second == x.first + Int(1));
  const Int first = y.first * Int(width);
  taps.at[0] = first + x.first;
  taps.weight[0] = weight;
  if (nearest) return;
  const Int second = y.second * Int(width);
  const Float upper = weight * (1.0f - y.share), lower = weight * y.share;
  taps.at[1] = first + x.second;
  taps.at[2] = second + x.first;
  taps.at[3] = second + x.second;
  taps.weight[0] = upper * (1.0f - x.share);
  taps.weight[1] = upper * x.share;
  taps.weight[2] = lower * (1.0f - x.share);
  taps.weight[3] = lower * x.share;
}

/// Adds texels times `weight`; of bytes.
template <unsigned channels>
HWY_INLINE void addTexels(const Int& bits, bool srgb, const Float& weight, Texel& sum) {
  const auto add = [&](const Int& byte, Float& to) HWY_ATTR {
    const Float number = toFloat(byte);
    to = mulAdd(srgb ? decoded(number) : number, weight, to);
  };
  if (channels & kRed) add(bits & Int(255), sum.rgb.x);
  if (channels & kGreen) add(shiftRight<8>(bits) & Int(255), sum.rgb.y);
  if (channels & kBlue) add(shiftRight<16>(bits) & Int(255), sum.rgb.z);
  if (channels & kAlpha) sum.a = mulAdd(toFloat(shiftRightUnsigned<24>(bits)), weight, sum.a);
}

template <unsigned channels>
HWY_INLINE void addTaps(const TextureLevel& level, bool srgb, const LevelTaps& taps, Texel& sum) {
  if (taps.adjacent) {
    for (std::size_t row = 0; row < 4; row += 2) {
      Int first, second;
      gatherTwos(level.texels, taps.at[row], first, second);
      addTexels<channels>(first, srgb, taps.weight[row], sum);
      addTexels<channels>(second, srgb, taps.weight[row + 1], sum);
    }
    return;
  }
  for (std::size_t i = 0; i < taps.count; ++i) {
    addTexels<channels>(gather(level.texels, taps.at[i]), srgb, taps.weight[i], sum);
  }
}

/// How often the texture is halved until a texel is as large as a pixel; below 0 it is shown larger than it is.
HWY_INLINE Float levelOfDetail(const Texture& texture, const TextureSpot& spot) {
  const Float2 size(Float(static_cast<float>(texture.width())), Float(static_cast<float>(texture.height())));
  const Float2 right = spot.right * size, up = spot.up * size;
  const Float squared = max(dot(right, right), dot(up, up));
  return 0.5f * log2(clamp(squared, 1e-20f, 1e20f));
}

/// Which sizes of a texture each place reads.
struct ReadLevels {
  Mask larger;           ///< it is shown larger than it is, by a filter of its own
  Float level;           ///< where levels are blended, with the share of the next
  Float lowest, highest; ///< the levels that are read where it is not
  bool ownFilter;        ///< what is shown larger and smaller differ by their filters
};

HWY_INLINE ReadLevels levelsOf(const Texture& texture, const TextureUse& use, const TextureSpot& spot) {
  const Float detail = levelOfDetail(texture, spot);
  const bool blended = mixesLevels(use.minFilter);
  const auto last = static_cast<float>(texture.levels() - 1);
  ReadLevels read;
  read.larger = detail <= 0.0f;
  const Float smaller =
      takesLevels(use.minFilter) ? clamp(blended ? detail : ceil(detail - 0.5f), 0.0f, last) : Float(0.0f);
  read.level = select(detail > 0.0f, smaller, 0.0f); // not of what is not a number
  read.lowest = floor(read.level);
  read.highest = blended ? ceil(read.level) : read.level;
  read.ownFilter = use.nearest != takesNearestTexel(use.minFilter);
  return read;
}

/// The largest level that the lanes `where` read; one of them is set.
HWY_INLINE std::size_t finestRead(const Texture& texture, const TextureUse& use, const TextureSpot& spot,
                                  const Mask& where) {
  return static_cast<std::size_t>(leastOf(where, levelsOf(texture, use, spot).lowest));
}

/// Lanes differ in their levels by few, so all lanes read one level at a time.
inline HWY_NOINLINE void findTaps(const Texture& texture, const TextureUse& use, const TextureSpot& spot,
                                  const Mask& where, Taps& taps) {
  // Not a number compares as false: what a triangle without area leads to is some texel.
  const Mask placed = (abs(spot.uv.x) < 1e6f) & (abs(spot.uv.y) < 1e6f);
  const Float2 uv = select(placed, spot.uv, Float2(Float(0.0f)));
  const ReadLevels read = levelsOf(texture, use, spot);
  taps.count = 0;
  const auto add = [&](std::size_t level, bool nearest, const Mask& lanes, const Float& weight) HWY_ATTR {
    LevelTaps& of = taps.of[taps.count++];
    of.level = level;
    setTaps(use, std::max(texture.width() >> level, 1), std::max(texture.height() >> level, 1), nearest, uv,
            select(lanes, weight, Float(0.0f)), of);
  };
  if (read.ownFilter && any(read.larger & where)) add(0, use.nearest, read.larger, 1.0f);
  const Mask levelled = read.ownFilter ? andNot(read.larger, where) : where;
  if (any(levelled)) {
    const auto first = static_cast<std::size_t>(leastOf(levelled, read.lowest));
    const auto last = static_cast<std::size_t>(mostOf(levelled, read.highest));
    for (std::size_t i = first; i <= last; ++i) {
      const Float number(static_cast<float>(i));
      const Mask reads = levelled & (read.lowest <= number) & (read.highest >= number);
      if (any(reads)) add(i, takesNearestTexel(use.minFilter), reads, 1.0f - abs(read.level - number));
    }
  }
  taps.finest = taps.count > 0 ? taps.of[0].level : texture.levels() - 1;
}

/// The texture's bytes at each place.
template <unsigned channels>
HWY_INLINE Texel bytesAt(const Texture& texture, const Taps& taps) {
  const Pyramid& pyramid = texture.from(taps.finest);
  Texel sum{};
  for (std::size_t i = 0; i < taps.count; ++i) {
    addTaps<channels>(pyramid.levels.data()[taps.of[i].level], texture.srgb(), taps.of[i], sum);
  }
  return sum;
}

inline constexpr float kOfByte = 1.0f / 255.0f;

/// The texture at each place.
template <unsigned channels>
inline HWY_NOINLINE Texel sampled(const Texture& texture, const Taps& taps) {
  const Texel bytes = bytesAt<channels>(texture, taps);
  return {bytes.rgb * Float(texture.srgb() ? 1.0f : kOfByte), bytes.a * kOfByte};
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
