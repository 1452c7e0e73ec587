#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"

namespace gnomon {

/// The alpha of a picture, a byte a texel, for readers of a few texels here and there: squares of 8 x 8 lie together.
class AlphaPlane {
 public:
  explicit AlphaPlane(const Image& image); ///< REQUIRES: 8-bit RGBA

  /// The next smaller level: half the size, rounded down but to no less than 1; means of the texels.
  AlphaPlane halved() const;

  int width() const { return width_; } ///< texels
  int height() const { return height_; }
  /// REQUIRES: a texel of the picture.
  std::uint8_t at(std::size_t column, std::size_t row) const { return texels_[placeOf(column, row)]; }
  std::size_t bytes() const { return texels_.size(); }

 private:
  static constexpr std::size_t kSide = 8;

  AlphaPlane(int width, int height);

  static std::size_t squaresOf(int texels) { return (static_cast<std::size_t>(texels) + kSide - 1) / kSide; }
  std::size_t placeOf(std::size_t column, std::size_t row) const {
    return (row / kSide * squaresAcross_ + column / kSide) * kSide * kSide + row % kSide * kSide + column % kSide;
  }

  int width_, height_;
  std::size_t squaresAcross_;
  std::vector<std::uint8_t> texels_; ///< of whole squares
};

/// The same in all of a texture's levels, the picture's own first, the last of one texel.
class AlphaLevels {
 public:
  explicit AlphaLevels(AlphaPlane largest);

  const AlphaPlane& largest() const { return levels_.front(); }
  const AlphaPlane& of(std::size_t level) const { return levels_[level]; } ///< REQUIRES: level < count()
  std::size_t count() const { return levels_.size(); }
  std::size_t bytes() const;

 private:
  std::vector<AlphaPlane> levels_;
};

/// A checked picture of a scene's file, decoded on first use, from any thread.
class SceneImage {
 public:
  /// `pointer`: its place in the file, for problems.
  SceneImage(CheckedImage file, std::string pointer);
  /// One that needs no decoding: 8-bit RGBA.
  explicit SceneImage(Image decoded);

  int width() const { return size_.width; }
  int height() const { return size_.height; }
  /// The most that it takes: its pixels, or its file where that is larger.
  std::uint64_t bytes() const { return bytes_; }

  /// Decodes it unless that is done, and keeps the pixels instead of the encoded bytes. A problem where memory is
  /// short.
  Status decode() const;
  /// 8-bit RGBA. REQUIRES: decode() gives no problem.
  const Image& pixels() const { return *decoded(); }
  /// Whether its file ends before the picture does.
  bool cutShort() const { return cutShort_; }
  /// What decoding it has found to be wrong with its data, as a sentence that names its place; empty = nothing so far.
  std::string damage() const;
  /// Their alpha: the same for all who hold it. REQUIRES: as pixels(). Throws std::bad_alloc.
  std::shared_ptr<const AlphaLevels> alpha() const;

  /// The same without keeping the pixels, in pieces as of decodeRows(), or all at once where they are kept.
  Status readRows(int atOnce, const TakeRows& take) const;

 private:
  const std::shared_ptr<const Image>& decoded() const;
  void note(const std::string& wrong) const;
  Problem withoutMemory() const;

  ImageSize size_;
  std::uint64_t bytes_ = 0;
  bool cutShort_ = false;
  std::string pointer_;
  mutable std::once_flag once_;
  mutable std::mutex mutex_;                         ///< of `file_`, `wrong_` and `alpha_`
  mutable std::shared_ptr<const CheckedImage> file_; ///< none once the pixels are kept
  mutable std::string wrong_;                        ///< in the decoder's words
  mutable std::shared_ptr<const Image> decoded_;
  mutable std::weak_ptr<const AlphaLevels> alpha_;
};

/// Puts the place in the glTF on problems of the codec, which knows only bytes.
Problems locatedImageProblems(Problems problems, const std::string& pointer);

using SceneImages = std::vector<std::shared_ptr<const SceneImage>>;

/// What decoding has found to be wrong with them so far: a sentence each.
std::vector<std::string> damageOf(const SceneImages& images);

/// Decodes those with these indices, in parallel. The problems of all, in their order.
Status decodeImages(const SceneImages& images, std::span<const int> indices);

} // namespace gnomon
