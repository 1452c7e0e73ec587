#include "server/wire/frame_pictures.h"

#include <algorithm>
#include <string>

#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

bool isView(std::string_view name) {
  const auto& all = kSpellings<View>;
  return std::any_of(all.begin(), all.end(), [&](const Spelling& view) { return view.name == name; });
}

bool isFileType(std::string_view type) {
  return std::any_of(kFormatTraits.begin(), kFormatTraits.end(),
                     [&](const FormatTraits& format) { return format.mediaType == type; });
}

/// The planes of encodeI420 (renderer/image).
bool isRawPicture(const PictureNews& picture) {
  constexpr int kMostSide = 65'535;
  if (picture.width < 1 || picture.height < 1 || picture.width > kMostSide || picture.height > kMostSide) return false;
  const auto width = static_cast<std::uint64_t>(picture.width), height = static_cast<std::uint64_t>(picture.height);
  return picture.bytes == width * height + 2 * ((width + 1) / 2) * ((height + 1) / 2);
}

bool isPicture(const PictureNews& picture, std::size_t count) {
  if (!isView(picture.view) || picture.bytes == 0 || picture.bytes > kMostResultBytes) return false;
  if (picture.contentType == kRawVideo) return count == 1 && isRawPicture(picture);
  return isFileType(picture.contentType) && picture.width == 0 && picture.height == 0;
}

} // namespace

std::optional<std::size_t> bytesOf(const std::vector<PictureNews>& pictures) {
  if (pictures.empty() || pictures.size() > kViewTraits.size()) return std::nullopt;
  std::size_t bytes = 0;
  for (auto picture = pictures.begin(); picture != pictures.end(); ++picture) {
    const bool isTwice =
        std::any_of(pictures.begin(), picture, [&](const PictureNews& other) { return other.view == picture->view; });
    if (isTwice || !isPicture(*picture, pictures.size())) return std::nullopt;
    bytes += picture->bytes; // a few times kMostResultBytes at most
  }
  return bytes <= kMostResultBytes ? std::optional(bytes) : std::nullopt;
}

Result<FramePictures> FramePictures::of(std::vector<PictureNews> pictures, SharedBytes bytes) {
  if (bytesOf(pictures) != bytes.size()) {
    return Problem{ProblemCode::internal, "", "The frame's bytes are not those of its pictures.", "", ""};
  }
  return FramePictures(std::move(pictures), std::move(bytes));
}

} // namespace gnomon
