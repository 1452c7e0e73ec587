// Triangles with holes: which of the pixels that they cover they fill is asked for sixteen pixels at a time.
#if defined(GNOMON_CPU_RASTER_HOLED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_HOLED_INL_H
#undef GNOMON_CPU_RASTER_HOLED_INL_H
#else
#define GNOMON_CPU_RASTER_HOLED_INL_H
#endif

#include <algorithm>
#include <bit>

#include "renderer/cpu/lanes/packing-inl.h"
#include "renderer/cpu/raster/raster.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

template <DepthRange range, class Number>
HWY_INLINE auto isNearer(const Number& depth, const Number& than) {
  if constexpr (range == DepthRange::reversed) return depth > than;
  if constexpr (range == DepthRange::clamped) return depth < than;
}

static_assert(HoledPlaces::kAsked == kLanes);

/// Pixels that such triangles cover and nothing drawn before hides. They wait until there are sixteen, and take their
/// places in the order in which they came.
template <DepthRange range, int samples>
class HoledPixels {
 public:
  /// `depths` and `numbers`: of the whole picture; null = not asked for.
  HoledPixels(const RasterInput& input, float* depths, std::uint32_t* numbers)
      : input_(input), depths_(depths), numbers_(numbers) {}

  /// What is behind all: of samples that a triangle does not cover.
  static constexpr float kBehind = range == DepthRange::reversed ? -1.0f : 2.0f;

  /// Those of a block's pixels that are `asked` for. `first`: its first sample; `depth[s]`: at sample s of each.
  HWY_INLINE void add(std::uint32_t number, bool turned, int column, int row, std::size_t first, const Mask& asked,
                      const Float (&depth)[samples]) {
    const std::uint32_t instance = input_.slots[number / kClusterTriangles].instance;
    if (instance != pixels_.instance) settle();
    pixels_.instance = instance;
    const Packing packing(asked);
    const std::size_t end = count_;
    packing.store(Int(static_cast<std::int32_t>(number)), pixels_.number + end);
    packing.store((laneNumbers() & Int(kBlockSide - 1)) + Int(column * kBlockSide), pixels_.x + end);
    packing.store(shiftRight<2>(laneNumbers()) + Int(row * kBlockSide), pixels_.y + end);
    packing.store(laneNumbers(), place_ + end);
    for (int s = 0; s < samples; ++s) packing.store(depth[s], depth_[s] + end);
    count_ += packing.count();
    for (std::size_t i = end; i < count_; ++i) block_[i] = first;
    if (turned) turned_ |= ((1u << packing.count()) - 1u) << end;
    if (count_ >= kLanes) settleFirst(kLanes);
  }

  /// All of them.
  HWY_INLINE void settle() {
    if (count_ > 0) settleFirst(count_);
  }

 private:
  HWY_NOINLINE void settleFirst(std::size_t count) {
    const unsigned all = (1u << count) - 1u;
    pixels_.counterClockwise = ~turned_ & all;
    for (unsigned filled = input_.holes->filled(pixels_, all); filled != 0; filled &= filled - 1) {
      take(static_cast<std::size_t>(std::countr_zero(filled)));
    }
    count_ -= count;
    turned_ >>= count;
    if (count_ > 0) moveDown(count);
  }

  HWY_INLINE void take(std::size_t pixel) {
    for (std::size_t s = 0; s < samples; ++s) {
      const std::size_t at = block_[pixel] + s * kBlockPlaces + static_cast<std::size_t>(place_[pixel]);
      if (!isNearer<range>(depth_[s][pixel], depths_[at])) continue;
      depths_[at] = depth_[s][pixel];
      if (numbers_ != nullptr) numbers_[at] = pixels_.number[pixel];
    }
  }

  HWY_INLINE void moveDown(std::size_t from) {
    const auto move = [&](auto* values) HWY_ATTR { std::copy_n(values + from, count_, values); };
    move(pixels_.number);
    move(pixels_.x);
    move(pixels_.y);
    move(place_);
    move(block_);
    for (auto& values : depth_) move(values);
  }

  const RasterInput& input_;
  float* depths_;
  std::uint32_t* numbers_;
  HoledPlaces pixels_;
  std::int32_t place_[HoledPlaces::kRoom] = {}; ///< in its block
  std::size_t block_[HoledPlaces::kRoom] = {};  ///< where that begins
  float depth_[samples][HoledPlaces::kRoom] = {};
  unsigned turned_ = 0; ///< a bit each
  std::size_t count_ = 0;
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
