#include "renderer/image/image_codec.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "renderer/image/image_container.h"
#include "renderer/image/picture_decode.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxMessage = 200; ///< characters of the library's own words in a problem

/// The library's words, made fit for a problem: one line, ASCII, short.
std::string oneLine(std::string text) {
  if (text.size() > kMaxMessage) text.resize(kMaxMessage);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, ' ');
  return text;
}

Status checkSize(ImageSize size, int maxSide, std::int64_t maxPixels) {
  const std::string actual = std::to_string(size.width) + "x" + std::to_string(size.height);
  if (size.width > maxSide || size.height > maxSide) {
    return Problem{ProblemCode::tooLarge, "", "The image is too wide or too high.", std::to_string(maxSide) + " a side",
                   actual};
  }
  if (std::int64_t{size.width} * size.height > maxPixels) {
    return Problem{ProblemCode::tooLarge, "", "The image has too many pixels.", std::to_string(maxPixels) + " pixels",
                   actual};
  }
  return Done{};
}

std::string decodeInto(DecodedRows& rows, const CheckedImage& image) {
  const auto decode = image.format == PictureFormat::png    ? decodePng
                      : image.format == PictureFormat::jpeg ? decodeJpeg
                                                            : decodeWebp;
  return oneLine(decode(image.picture.bytes, rows));
}

} // namespace

Result<ImageSize> imageSize(std::span<const std::uint8_t> encoded) {
  const auto format = formatOf(encoded);
  if (!format) return unsupportedImage("The image is no PNG, JPEG or WebP.");
  return *format == PictureFormat::png    ? pngSize(encoded)
         : *format == PictureFormat::jpeg ? jpegSize(encoded)
                                          : webpSize(encoded);
}

Result<CheckedImage> checkImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels) {
  const auto size = imageSize(encoded);
  if (!size) return size.problems();
  if (auto status = checkSize(*size, maxSide, maxPixels); !status) return std::move(status).problems();
  const PictureFormat format = *formatOf(encoded);
  auto picture = format == PictureFormat::png    ? essentialPng(encoded)
                 : format == PictureFormat::jpeg ? essentialJpeg(encoded)
                                                 : essentialWebp(encoded);
  if (!picture) return std::move(picture).problems();
  if (format == PictureFormat::png) {
    if (const std::string wrong = unreadablePng(picture->bytes); !wrong.empty()) {
      return malformedImage("The PNG can't be read: " + wrong + ".");
    }
  }
  return CheckedImage{format, *size, *std::move(picture)};
}

DecodedImage decodeImage(const CheckedImage& image) {
  const auto [width, height] = image.size;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  DecodedRows rows(image.size, rgba.data());
  std::string wrong = decodeInto(rows, image);
  return {Image{width, height, {"R", "G", "B", "A"}, std::move(rgba)}, std::move(wrong)};
}

std::string decodeRows(const CheckedImage& image, int atOnce, const TakeRows& take) {
  DecodedRows rows(image.size, atOnce, take);
  return decodeInto(rows, image);
}

Result<Image> decodeImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels) {
  const auto checked = checkImage(encoded, maxSide, maxPixels);
  if (!checked) return checked.problems();
  DecodedImage decoded = decodeImage(*checked);
  if (checked->picture.cutShort) return malformedImage("The image is cut short.");
  if (!decoded.wrong.empty()) return malformedImage("The image could not be decoded: " + decoded.wrong + ".");
  return std::move(decoded.image);
}

DecodedRows::DecodedRows(const ImageSize& size, std::uint8_t* rgba) : size_(size), rgba_(rgba), held_(size.height) {}

DecodedRows::DecodedRows(const ImageSize& size, int atOnce, const TakeRows& take) : size_(size), take_(take) {
  holdRows(std::min(atOnce, size.height));
}

void DecodedRows::holdRows(int rows) {
  buffer_.resize(rowBytes() * static_cast<std::size_t>(rows));
  rgba_ = buffer_.data();
  held_ = rows;
}

std::uint8_t* DecodedRows::all() {
  if (held_ < size_.height) holdRows(size_.height);
  return rgba_;
}

void DecodedRows::complete(int end) {
  if (!take_ || (end < first_ + held_ && end < size_.height)) return;
  take_(first_, {rgba_, rowBytes() * static_cast<std::size_t>(end - first_)});
  first_ = end;
}

} // namespace gnomon
