#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderer/cpu/surface/pyramid.h"
#include "renderer/scene/scene_image.h"
#include "renderer/scene/texture_reads.h"

namespace gnomon::cpu {

/// An image as it is read in one color space. Its sizes are made when they are first read, from any thread: of an image
/// that only shows small, no more than small ones are kept.
class Texture {
 public:
  Texture(std::shared_ptr<const SceneImage> image, bool srgb);

  bool srgb() const { return srgb_; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t levels() const { return levels_; }

  bool isMade() const { return latest() != nullptr; }
  bool has(std::size_t finest) const { return isMade() && latest()->finest <= finest; }

  /// Makes the levels from `finest` on, where they are not there yet. A problem where the image can't be decoded.
  Status make(std::size_t finest) const;

  /// Valid as long as the texture. REQUIRES: an image that can be decoded.
  const Pyramid& from(std::size_t finest) const {
    const Pyramid* pyramid = latest();
    return pyramid != nullptr && pyramid->finest <= finest ? *pyramid : madeFrom(finest);
  }

  /// What its levels take beside the image.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  const Pyramid* latest() const { return latest_.load(std::memory_order_acquire); }
  const Pyramid& madeFrom(std::size_t finest) const;
  Result<Pyramid> pyramidFrom(std::size_t finest, const Pyramid& known) const;

  std::shared_ptr<const SceneImage> image_;
  bool srgb_;
  int width_, height_;
  std::size_t levels_;
  mutable std::atomic<const Pyramid*> latest_{nullptr};
  mutable std::mutex making_;
  mutable std::vector<std::unique_ptr<const Pyramid>> made_; ///< earlier ones may still be read
  mutable std::atomic<std::size_t> bytes_{0};
};

/// A texture, and the largest level that is read of it.
struct ReadTexture {
  TextureImage texture;
  std::size_t finest = 0;
};

/// A scene's textures, each made when it is first needed, from any thread.
class Textures {
 public:
  explicit Textures(const SceneImages& images);

  /// Whether all of these have been needed before.
  bool areMade(std::span<const TextureImage> wanted) const;

  /// Makes these on a thread of its own, while others work; need() waits for those that it still lacks. The result
  /// waits for all of them when it goes.
  std::future<void> makeAhead(std::span<const ReadTexture> wanted) const;

  /// Makes these now, in parallel; outside of any parallel loop. The problems of images that can't be decoded.
  Status need(std::span<const ReadTexture> wanted) const;

  /// REQUIRES: an index into Scene::images, of an image that can be decoded.
  const Texture& of(int image, bool srgb) const { return of({image, srgb}); }
  const Texture& of(const TextureImage& of) const {
    return textures_[2 * static_cast<std::size_t>(of.image) + (of.srgb ? 1 : 0)];
  }

  /// What they take beside the images.
  std::size_t bytes() const;

 private:
  std::deque<Texture> textures_; ///< two an image: linear and sRGB
};

} // namespace gnomon::cpu
