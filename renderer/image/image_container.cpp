#include "renderer/image/image_container.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace gnomon {
namespace {

constexpr std::array<std::uint8_t, 3> kJpegSignature{0xff, 0xd8, 0xff};
constexpr std::array<std::uint8_t, 4> kRiffSignature{'R', 'I', 'F', 'F'};
constexpr std::array<std::uint8_t, 4> kWebpForm{'W', 'E', 'B', 'P'};

bool startsWith(EncodedBytes bytes, EncodedBytes prefix) {
  return bytes.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), bytes.begin());
}

constexpr std::size_t kSignatureSize = kPngSignature.size();
constexpr std::size_t kHeaderEnd = kSignatureSize + kPngFrameBytes + kPngHeaderBytes;
constexpr std::uint32_t kMaxNumber = 0x7fffffff; ///< of a PNG four-byte integer

constexpr std::array<std::string_view, 5> kEssentialChunks{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};

std::string_view typeAt(EncodedBytes bytes, std::size_t chunk) {
  return {reinterpret_cast<const char*>(bytes.data()) + chunk + 4, 4};
}

bool isCritical(std::string_view type) {
  return (type[0] & 0x20) == 0;
}

} // namespace

std::optional<PictureFormat> formatOf(EncodedBytes encoded) {
  if (startsWith(encoded, kPngSignature)) return PictureFormat::png;
  if (startsWith(encoded, kJpegSignature)) return PictureFormat::jpeg;
  if (startsWith(encoded, kRiffSignature) && encoded.size() >= 12 && startsWith(encoded.subspan(8), kWebpForm)) {
    return PictureFormat::webp;
  }
  return std::nullopt;
}

std::uint32_t bigEndian(EncodedBytes bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[offset + i];
  return value;
}

std::uint32_t littleEndian(EncodedBytes bytes, std::size_t offset, std::size_t count) {
  return static_cast<std::uint32_t>(littleEndian(bytes.subspan(offset, count)));
}

Problem malformedImage(const std::string& detail) {
  return {ProblemCode::malformed, "", detail};
}

Problem unsupportedImage(const std::string& detail) {
  return {ProblemCode::unsupportedFeature, "", detail};
}

Result<ImageSize> pngSize(EncodedBytes encoded) {
  if (encoded.size() < kHeaderEnd) return malformedImage("The PNG ends within its header.");
  if (typeAt(encoded, kSignatureSize) != "IHDR" || bigEndian(encoded, kSignatureSize, 4) != kPngHeaderBytes) {
    return malformedImage("The PNG does not begin with its header.");
  }
  const std::uint32_t width = bigEndian(encoded, kSignatureSize + 8, 4);
  const std::uint32_t height = bigEndian(encoded, kSignatureSize + 12, 4);
  if (width == 0 || height == 0 || width > kMaxNumber || height > kMaxNumber) {
    return malformedImage("The PNG has no valid width and height.");
  }
  return ImageSize{static_cast<int>(width), static_cast<int>(height)};
}

Result<EssentialImage> essentialPng(EncodedBytes encoded) {
  Bytes essential(encoded.begin(), encoded.begin() + kSignatureSize);
  std::size_t chunk = kSignatureSize;
  constexpr std::size_t kBeforeData = 8; ///< of a chunk
  while (encoded.size() - chunk >= kBeforeData) {
    const std::uint32_t length = bigEndian(encoded, chunk, 4);
    const std::string_view type = typeAt(encoded, chunk);
    const std::size_t whole = kPngFrameBytes + std::size_t{length};
    const std::size_t next = chunk + std::min(whole, encoded.size() - chunk);
    const bool wanted = std::ranges::find(kEssentialChunks, type) != kEssentialChunks.end();
    if (!wanted && isCritical(type)) return unsupportedImage("The PNG has a critical chunk of an unknown type.");
    if (wanted) essential.insert(essential.end(), encoded.begin() + chunk, encoded.begin() + next);
    if (next - chunk < whole) break;
    if (type == "IEND") return EssentialImage{std::move(essential)};
    chunk = next;
  }
  return EssentialImage{std::move(essential), true};
}

} // namespace gnomon
