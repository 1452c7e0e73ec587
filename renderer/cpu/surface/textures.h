#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <span>
#include <vector>

#include "renderer/cpu/surface/texture.h"
#include "renderer/scene/texture_reads.h"

namespace gnomon::cpu {

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
