#include "renderer/image/image_codec.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "renderer/image/decoded_rows.h"
#include "renderer/image/exr_encode.h"
#include "renderer/image/exr_layout.h"
#include "renderer/image/image_container.h"
#include "renderer/image/jpeg_decode.h"
#include "renderer/image/png_decode.h"
#include "renderer/image/webp_decode.h"

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

Problem failure(ProblemCode code, const std::string& what, const std::string& message) {
  return {code, "", (message.empty() ? what : what + ": " + oneLine(message)) + ".", "", ""};
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

Status decodeInto(DecodedRows& rows, const CheckedImage& image) {
  const auto decode = image.format == PictureFormat::png    ? decodePng
                      : image.format == PictureFormat::jpeg ? decodeJpeg
                                                            : decodeWebp;
  const std::string message = decode(image.picture, rows);
  if (!message.empty()) return failure(ProblemCode::malformed, "The image could not be decoded", message);
  return Done{};
}

} // namespace

Result<Bytes> encodeExr(std::span<const ImageLayer> layers, ExrCompression compression, ExrPixelType pixelType) {
  auto parts = exrParts(layers, pixelType);
  if (!parts) return std::move(parts).problems();
  return encodeExrParts(*parts, compression);
}

Result<ImageSize> imageSize(std::span<const std::uint8_t> encoded) {
  const auto format = formatOf(encoded);
  if (!format) return unsupportedImage("The image is no PNG, JPEG or WebP.");
  switch (*format) {
    case PictureFormat::png:
      return pngSize(encoded);
    case PictureFormat::jpeg:
      return jpegSize(encoded);
    case PictureFormat::webp:
      return webpSize(encoded);
  }
  return unsupportedImage("The image is no PNG, JPEG or WebP.");
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
  return CheckedImage{format, *size, *std::move(picture)};
}

Result<Image> decodeImage(const CheckedImage& image) {
  const auto [width, height] = image.size;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  DecodedRows rows(image.size, rgba.data());
  if (Status done = decodeInto(rows, image); !done) return std::move(done).problems();
  return Image{width, height, {"R", "G", "B", "A"}, std::move(rgba)};
}

Status decodeRows(const CheckedImage& image, int atOnce, const TakeRows& take) {
  DecodedRows rows(image.size, atOnce, take);
  return decodeInto(rows, image);
}

Result<Image> decodeImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels) {
  const auto checked = checkImage(encoded, maxSide, maxPixels);
  if (!checked) return checked.problems();
  return decodeImage(*checked);
}

} // namespace gnomon
