#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/scene/texture_reads.h"

namespace gnomon::cpu {

/// The largest level that is read of each of a scene's textures, while many threads find out.
class FinestLevels {
 public:
  explicit FinestLevels(std::size_t images) : levels_(2 * images) {
    for (auto& level : levels_) level.store(kNone, std::memory_order_relaxed);
  }

  void add(const TextureImage& texture, std::size_t level) {
    auto& known = levels_[placeOf(texture)];
    auto before = known.load(std::memory_order_relaxed);
    const auto now = static_cast<std::uint8_t>(level);
    while (now < before && !known.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
    }
  }

  /// More than any texture has where none is read.
  std::size_t of(const TextureImage& texture) const { return levels_[placeOf(texture)]; }

 private:
  static constexpr std::uint8_t kNone = 255;
  static std::size_t placeOf(const TextureImage& texture) {
    return 2 * static_cast<std::size_t>(texture.image) + (texture.srgb ? 1 : 0);
  }
  std::vector<std::atomic<std::uint8_t>> levels_;
};

} // namespace gnomon::cpu
