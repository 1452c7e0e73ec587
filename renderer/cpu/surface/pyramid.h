#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/core/vectors.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"

namespace gnomon::cpu {

/// One size of a texture. RGBA, 8 bits each, red in the lowest; row by row from the image's first, which is at v = 0.
struct TextureLevel {
  const std::uint32_t* texels = nullptr; ///< null: this size is not there
  int width = 0;
  int height = 0;
};

/// A texture in all of its sizes: the image's own, then halves, rounded down, to one texel.
struct Pyramid {
  using Texels = UnfilledVector<std::uint32_t>;

  bool srgb = false;
  std::size_t finest = 0;                           ///< the first level that is there; all smaller ones are
  std::vector<TextureLevel> levels;                 ///< the first is as large as the image
  std::vector<std::shared_ptr<const Texels>> owned; ///< what they point to, one a level; null for the image's own
};

/// How many sizes an image of this size has.
std::size_t levelsOf(int width, int height);

/// A level that smaller ones can be made from.
struct GivenLevel {
  std::size_t level = 0;
  const std::uint32_t* texels = nullptr;
  std::shared_ptr<const Pyramid::Texels> owned; ///< what holds them; null for the image's own
};

/// The smaller levels average in linear light where the image is sRGB, as OpenGL's do. Levels from `finest` on are
/// made, but for those that `known`, an earlier one of the same image, has already. `size`: the image's. REQUIRES: no
/// level is asked for that is larger than the one given.
Pyramid pyramidOf(const ImageSize& size, bool srgb, GivenLevel from, std::size_t finest, const Pyramid& known = {});

/// The same from the image, which with `finest` 0 outlives it.
Pyramid pyramidOf(const Image& image, bool srgb, std::size_t finest = 0, const Pyramid& known = {});

/// A small level of an image whose rows come from the top down, so that the image itself never is in memory. The same
/// texels as pyramidOf() makes of the whole image.
class HalvedRows {
 public:
  /// `level`: no larger than evenLevels() of the image.
  HalvedRows(const ImageSize& size, bool srgb, std::size_t level);

  /// How many rows are best added at a time: a multiple of DecodedRows::kStep and of what a row of the level is made
  /// from.
  int atOnce() const { return atOnce_; }
  /// Rows of 8-bit RGBA from row `first` on; a multiple of atOnce(), or up to the last one.
  void add(int first, std::span<const std::uint8_t> rgba);

  /// Once all rows are there.
  GivenLevel given() && { return {level_, texels_->data(), std::move(texels_)}; }

 private:
  void addFew(std::size_t first, const std::uint32_t* texels, std::size_t rows);

  std::size_t width_;
  bool srgb_;
  std::size_t level_;
  int atOnce_;
  std::shared_ptr<Pyramid::Texels> texels_;
  std::vector<Pyramid::Texels> between_; ///< of the levels on the way, for atOnce() rows
};

/// How often both sides of an image can be halved before one is odd.
std::size_t evenLevels(const ImageSize& size);

} // namespace gnomon::cpu
