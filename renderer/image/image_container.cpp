#include "renderer/image/image_container.h"

#include <algorithm>
#include <array>

namespace gnomon {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> kJpegSignature{0xff, 0xd8, 0xff};
constexpr std::array<std::uint8_t, 4> kRiffSignature{'R', 'I', 'F', 'F'};
constexpr std::array<std::uint8_t, 4> kWebpForm{'W', 'E', 'B', 'P'};

bool startsWith(EncodedBytes bytes, EncodedBytes prefix) {
  return bytes.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), bytes.begin());
}

} // namespace

std::optional<codec::Format> formatOf(EncodedBytes encoded) {
  if (startsWith(encoded, kPngSignature)) return codec::Format::png;
  if (startsWith(encoded, kJpegSignature)) return codec::Format::jpeg;
  if (startsWith(encoded, kRiffSignature) && encoded.size() >= 12 && startsWith(encoded.subspan(8), kWebpForm)) {
    return codec::Format::webp;
  }
  return std::nullopt;
}

std::uint32_t bigEndian(EncodedBytes bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[offset + i];
  return value;
}

std::uint32_t littleEndian(EncodedBytes bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8 | bytes[offset + i];
  return value;
}

Problem malformedImage(const std::string& detail) {
  return {ProblemCode::malformed, "", detail, "", ""};
}

Problem unsupportedImage(const std::string& detail) {
  return {ProblemCode::unsupportedFeature, "", detail, "", ""};
}

} // namespace gnomon
