#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/read_textures.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/show/read_textures.h"

#include <algorithm>
#include <atomic>
#include <hwy/foreach_target.h>

#include "renderer/cpu/show/packet-inl.h"
#include "renderer/cpu/show/view_squares.h"

#ifndef GNOMON_CPU_FINEST_LEVELS
#define GNOMON_CPU_FINEST_LEVELS
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
#endif

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Adds what the fragments of the square whose lower left pixel is x, y read.
void addReadOn(const FrameScene& scene, const Textures& textures, const FragmentList& list, int x, int y,
               FinestLevels& finest) {
  const SampleMeans means = sampleMeans(1);
  for (std::size_t i = 0; i < list.count; i += kLanes) {
    const Fragments fragments = packetAt(list, i, x, y, means).fragments;
    for (unsigned left = bitsOf(fragments.shown); left != 0;) {
      const OfInstance own = instanceShown(scene, fragments, left);
      left &= ~bitsOf(own.lanes);
      InstanceSurface(scene, textures, own, fragments)
          .forEachTexture([&](const TextureImage& read, const TextureUse& use, const TextureSpot& spot)
                              HWY_ATTR { finest.add(read, finestRead(textures.of(read), use, spot, own.lanes)); });
    }
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {
namespace {
GNOMON_EXPORT_KERNEL(addReadOn);
} // namespace

std::vector<ReadTexture> readTextures(const FrameScene& scene, const Textures& textures, const DepthBuffer& buffer,
                                      std::span<const TextureImage> wanted) {
  FinestLevels finest(scene.scene.images.size());
  forEachSquare(buffer, [&](const FragmentList& list, int x, int y) {
    GNOMON_KERNEL(addReadOn)(scene, textures, list, x, y, finest);
  });
  std::vector<ReadTexture> read;
  for (const TextureImage& each : wanted) {
    read.push_back({each, std::min(finest.of(each), textures.of(each).levels() - 1)});
  }
  return read;
}

} // namespace gnomon::cpu
#endif
