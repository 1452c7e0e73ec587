#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::cli {

/// A text that a video says of itself.
struct VideoTag {
  std::string name;
  std::string text;
};

/// State of a sequence's video while it is received: how many frames are complete, and the tag at its end. Its frames
/// are not kept.
class WebmWatch {
 public:
  void read(std::string_view bytes);

  int frames() const { return frames_; }
  const std::optional<VideoTag>& tag() const { return tag_; }

 private:
  std::size_t readElement(std::string_view bytes);

  std::string waiting_;       ///< an element's head that is not whole, or the tags
  std::uint64_t skipped_ = 0; ///< bytes of an element that are still to come
  bool isCluster_ = false;    ///< that element
  bool isBroken_ = false;     ///< no more is read
  int frames_ = 0;
  std::optional<VideoTag> tag_;
};

} // namespace gnomon::cli
