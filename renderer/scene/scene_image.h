#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/image/image.h"
#include "renderer/image/image_codec.h"
#include "renderer/scene/alpha_plane.h"

namespace gnomon {

/// A picture of a scene's file, whose size and structure have been checked. Its pixels are decoded when they are first
/// asked for, from any thread.
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

  /// Decodes it now, if that has not been done, and keeps the pixels instead of the encoded bytes. A problem, at its
  /// place in the file, where there is no memory for it.
  Status decode() const;
  /// 8-bit RGBA. REQUIRES: decode() gives no problem.
  const Image& pixels() const { return *decoded(); }
  /// Whether its file ends before the picture does.
  bool cutShort() const { return cutShort_; }
  /// What decoding it has found to be wrong with its data, as a sentence that names its place; empty = nothing so far.
  std::string damage() const;
  /// Their alpha: the same for all who hold it. REQUIRES: as pixels(). Throws std::bad_alloc.
  std::shared_ptr<const AlphaLevels> alpha() const;

  /// The same for a caller who needs them but once, as decodeRows() gives them: decoded and not kept, or all at once of
  /// those that are kept.
  Status readRows(int atOnce, const TakeRows& take) const;

 private:
  const std::shared_ptr<const Image>& decoded() const;
  void note(const std::string& wrong) const;
  Problem noMemory() const;

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
