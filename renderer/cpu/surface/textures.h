#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderer/scene/texture_images.h"

namespace gnomon::cpu {

/// One size of a texture. RGBA, 8 bits each, red in the lowest; row by row from the image's first, which is at v = 0.
struct TextureLevel {
  const std::uint32_t* texels = nullptr;
  int width = 0;
  int height = 0;
};

/// A texture in all of its sizes: the image's own, then halves, rounded down, to one texel.
struct Pyramid {
  bool srgb = false;
  std::vector<TextureLevel> levels;              ///< the first is the image itself
  std::vector<std::vector<std::uint32_t>> owned; ///< what the others point to
};

/// Whether work is shared out. One core alone where a parallel loop is running already.
enum class Cores { one, all };

/// The smaller levels average in linear light where the image is sRGB, as OpenGL's do. The image outlives the pyramid.
Pyramid pyramidOf(const Image& image, bool srgb, Cores cores = Cores::one);

/// A scene's textures, each made when it is first needed, from any thread.
class Textures {
 public:
  explicit Textures(SceneImages images);

  /// Decodes the images of these on a thread of its own, while others work; need() waits for those that it still lacks.
  /// The result waits for all of them when it goes.
  std::future<void> decodeAhead(std::span<const TextureImage> wanted) const;

  /// Makes these now, in parallel; outside of any parallel loop. The problems of images that can't be decoded.
  Status need(std::span<const TextureImage> wanted) const;

  /// REQUIRES: an index into Scene::images, of an image that can be decoded.
  const Pyramid& of(int image, bool srgb) const {
    const Pyramid* pyramid = madeOf(image, srgb).ready.load(std::memory_order_acquire);
    return pyramid != nullptr ? *pyramid : make(image, srgb, Cores::one);
  }

  /// What the textures that were made take beside the images.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Made {
    std::atomic<const Pyramid*> ready{nullptr};
    std::mutex making;
    std::unique_ptr<const Pyramid> pyramid;
  };

  std::vector<TextureImage> missing(std::span<const TextureImage> wanted) const;
  Made& madeOf(int image, bool srgb) const { return made_[2 * static_cast<std::size_t>(image) + (srgb ? 1 : 0)]; }
  const Pyramid& make(int image, bool srgb, Cores cores) const;

  SceneImages images_;
  std::unique_ptr<Made[]> made_; ///< two an image: linear and sRGB
  mutable std::atomic<std::size_t> bytes_{0};
};

} // namespace gnomon::cpu
