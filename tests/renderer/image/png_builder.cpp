#include "tests/renderer/image/png_builder.h"

namespace gnomon {
namespace {

void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void appendNumber(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::uint32_t crc32(const Bytes& bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// A zlib stream of one stored block (RFC 1950 and 1951). At most 65535 bytes.
Bytes stored(const Bytes& data) {
  const auto length = static_cast<std::uint16_t>(data.size());
  const auto low = [](unsigned value) { return static_cast<std::uint8_t>(value & 0xff); };
  Bytes stream{0x78, 0x01, 0x01, low(length), low(length >> 8u), low(~length), low(~length >> 8u)};
  append(stream, data);
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const std::uint8_t byte : data) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  appendNumber(stream, b << 16 | a);
  return stream;
}

} // namespace

Bytes pngChunk(const std::string& type, const Bytes& data) {
  Bytes body(type.begin(), type.end());
  append(body, data);
  Bytes chunk;
  appendNumber(chunk, static_cast<std::uint32_t>(data.size()));
  append(chunk, body);
  appendNumber(chunk, crc32(body));
  return chunk;
}

Bytes PngBuilder::build() const {
  Bytes header;
  appendNumber(header, width);
  appendNumber(header, height);
  append(header, {bitDepth, colorType, 0, 0, 0});
  Bytes filtered;
  for (const Bytes& row : rows) {
    filtered.push_back(0);
    append(filtered, row);
  }
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append(png, pngChunk("IHDR", header));
  for (const auto& [type, data] : beforePixels) append(png, pngChunk(type, data));
  append(png, pngChunk("IDAT", stored(filtered)));
  append(png, pngChunk("IEND", {}));
  return png;
}

} // namespace gnomon
