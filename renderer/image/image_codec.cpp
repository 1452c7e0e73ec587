#include "renderer/image/image_codec.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "renderer/core/stop.h"
#include "renderer/image/codec_loader.h"
#include "renderer/image/exr_layout.h"
#include "renderer/image/image_container.h"
#include "renderer/image/jpeg_decode.h"
#include "renderer/image/png_decode.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxMessage = 200; ///< characters of the library's own words in a problem

template <class Container>
codec::Sink sinkInto(Container& target) {
  return {&target, [](void* container, const std::uint8_t* bytes, std::size_t size) {
            auto& kept = *static_cast<Container*>(container);
            try {
              kept.insert(kept.end(), bytes, bytes + size);
            } catch (const std::bad_alloc&) {
              return false;
            }
            return true;
          }};
}

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

codec::Compression tableValue(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::none:
      return codec::Compression::none;
    case ExrCompression::rle:
      return codec::Compression::rle;
    case ExrCompression::zip:
      return codec::Compression::zip;
    case ExrCompression::piz:
      return codec::Compression::piz;
  }
  return codec::Compression::none;
}

/// Points into the part, whose own vectors must stay where they are.
struct PartView {
  std::vector<const char*> names;
  std::unique_ptr<bool[]> half;
  codec::FloatPart part;

  explicit PartView(const ExrPart& source) : half(std::make_unique<bool[]>(source.half.size())) {
    for (const std::string& name : source.channels) names.push_back(name.c_str());
    std::copy(source.half.begin(), source.half.end(), half.get());
    part = {source.name.c_str(), source.width, source.height,       static_cast<int>(names.size()),
            names.data(),        half.get(),   source.pixels.data()};
  }
};

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

} // namespace

Result<Bytes> encodeExr(std::span<const ImageLayer> layers, ExrCompression compression, ExrPixelType pixelType) {
  auto parts = exrParts(layers, pixelType);
  if (!parts) return std::move(parts).problems();
  std::vector<PartView> views;
  views.reserve(parts->size());
  std::vector<codec::FloatPart> tableParts;
  for (const ExrPart& part : *parts) tableParts.push_back(views.emplace_back(part).part);
  auto codec = imageCodec();
  if (!codec) return std::move(codec).problems();
  Bytes encoded;
  std::string message;
  const codec::Caller caller{Stop::current(),
                             [](void* stop) { return stop == nullptr || !static_cast<Stop*>(stop)->asked(); }};
  if (!(*codec)->encodeExr(tableParts.data(), tableParts.size(), tableValue(compression), caller, sinkInto(encoded),
                           sinkInto(message))) {
    stopIfAsked();
    return failure(ProblemCode::internal, "The EXR could not be written", message);
  }
  return encoded;
}

Result<ImageSize> imageSize(std::span<const std::uint8_t> encoded) {
  const auto format = formatOf(encoded);
  if (!format) return unsupportedImage("The image is no PNG, JPEG or WebP.");
  switch (*format) {
    case codec::Format::png:
      return pngSize(encoded);
    case codec::Format::jpeg:
      return jpegSize(encoded);
    case codec::Format::webp:
      return webpSize(encoded);
  }
  return unsupportedImage("The image is no PNG, JPEG or WebP.");
}

Result<CheckedImage> checkImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels) {
  const auto size = imageSize(encoded);
  if (!size) return size.problems();
  if (auto status = checkSize(*size, maxSide, maxPixels); !status) return std::move(status).problems();
  const codec::Format format = *formatOf(encoded);
  if (format == codec::Format::webp) {
    auto webp = essentialWebp(encoded);
    if (!webp) return std::move(webp).problems();
    return CheckedImage{format, *size, std::move(webp->color), std::move(webp->alpha)};
  }
  auto picture = format == codec::Format::png ? essentialPng(encoded) : essentialJpeg(encoded);
  if (!picture) return std::move(picture).problems();
  return CheckedImage{format, *size, *std::move(picture)};
}

Result<Image> decodeImage(const CheckedImage& image) {
  const auto [width, height] = image.size;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  std::string message;
  if (image.format == codec::Format::png) {
    message = decodePng(image.picture, image.size, rgba.data());
  } else if (image.format == codec::Format::jpeg) {
    message = decodeJpeg(image.picture, image.size, rgba.data());
  } else {
    auto codec = imageCodec();
    if (!codec) return std::move(codec).problems();
    const auto decodeWith = [&, width = width, height = height](auto decode, const Bytes& file) {
      return decode(image.format, file.data(), file.size(), width, height, rgba.data(), sinkInto(message));
    };
    const bool done = decodeWith((*codec)->decode, image.picture) &&
                      (image.alpha.empty() || decodeWith((*codec)->decodeAlpha, image.alpha));
    if (!done && message.empty()) message = "its reader says nothing more";
  }
  if (!message.empty()) return failure(ProblemCode::malformed, "The image could not be decoded", message);
  return Image{width, height, {"R", "G", "B", "A"}, std::move(rgba)};
}

Result<Image> decodeImage(std::span<const std::uint8_t> encoded, int maxSide, std::int64_t maxPixels) {
  const auto checked = checkImage(encoded, maxSide, maxPixels);
  if (!checked) return checked.problems();
  return decodeImage(*checked);
}

void warmImageCodec() {
  (void)imageCodec();
}

} // namespace gnomon
