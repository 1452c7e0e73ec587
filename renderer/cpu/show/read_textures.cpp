#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "renderer/cpu/show/read_textures.cpp" // NOLINT: Highway's foreach_target.h includes this file again
#include "renderer/cpu/show/read_textures.h"

#include <algorithm>
#include <hwy/foreach_target.h>

#include "renderer/cpu/show/finest_levels.h"
#include "renderer/cpu/show/packet-inl.h"
#include "renderer/cpu/show/show_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Adds what the fragments of the square whose lower left pixel is x, y read. `samples`: of a pixel.
void addReadOn(const FrameScene& scene, const Textures& textures, const FragmentList& list, int samples, int x, int y,
               FinestLevels& finest) {
  const SampleMeans means = sampleMeans(samples);
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
    GNOMON_KERNEL(addReadOn)(scene, textures, list, buffer.samples, x, y, finest);
  });
  std::vector<ReadTexture> read;
  for (const TextureImage& each : wanted) {
    read.push_back({each, std::min(finest.of(each), textures.of(each).levels() - 1)});
  }
  return read;
}

} // namespace gnomon::cpu
#endif
