#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "server/system/shared_bytes.h"
#include "server/wire/messages.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

/// How many bytes the pictures have together. Nothing where they can't be the pictures of a frame: none, a view that is
/// unknown or comes twice, another media type than a format's, no bytes or more than kMostResultBytes; or a raw picture
/// that is not alone or does not have the bytes of its size.
std::optional<std::size_t> bytesOf(const std::vector<PictureNews>& pictures);

/// The pictures of a frame with their bytes, which fit each other, from a worker as from a store.
class FramePictures {
 public:
  FramePictures() = default; ///< none

  /// Problem: internal, where bytesOf() the pictures are not these bytes.
  static Result<FramePictures> of(std::vector<PictureNews> pictures, SharedBytes bytes);

  const std::vector<PictureNews>& list() const { return list_; }
  const SharedBytes& bytes() const { return bytes_; } ///< of all, one after the other

  /// The picture of a video's frame; nullptr where they are others.
  const PictureNews* raw() const {
    return list_.size() == 1 && list_.front().contentType == kRawVideo ? &list_.front() : nullptr;
  }

  /// Calls visit(picture, its bytes) for one after the other until it returns false; whether it never did.
  template <class Visit>
  bool each(Visit&& visit) const {
    std::string_view rest = bytes_.view();
    for (const PictureNews& picture : list_) {
      if (!visit(picture, rest.substr(0, picture.bytes))) return false;
      rest = rest.substr(picture.bytes);
    }
    return true;
  }

 private:
  FramePictures(std::vector<PictureNews> list, SharedBytes bytes) : list_(std::move(list)), bytes_(std::move(bytes)) {}

  std::vector<PictureNews> list_;
  SharedBytes bytes_;
};

} // namespace gnomon
