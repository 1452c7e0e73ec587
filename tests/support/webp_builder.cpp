#include "tests/support/webp_builder.h"

#include <cstddef>

namespace gnomon::testing {
namespace {

void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void appendNumber(Bytes& bytes, std::size_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i & 0xff));
}

/// Numbers of some bits each, the least significant bit first.
struct BitWriter {
  Bytes bytes{};
  int used = 0; ///< bits of the last byte

  void write(std::uint32_t value, int bits) {
    for (int i = 0; i < bits; ++i) {
      if (used == 0) bytes.push_back(0);
      bytes.back() = static_cast<std::uint8_t>(bytes.back() | (value >> i & 1) << used);
      used = (used + 1) % 8;
    }
  }
};

/// A prefix code that gives the first 256 symbols of an alphabet 8 bits each, and no other any (RFC 9649, 3.7.2.1).
void writeByteCode(BitWriter& out, int alphabet) {
  constexpr int kLengths = 12; ///< the order of code lengths has 0 third and 8 twelfth
  out.write(0, 1);
  out.write(kLengths - 4, 4);
  for (int i = 0; i < kLengths; ++i) out.write(i == 2 || i == 11 ? 1 : 0, 3);
  out.write(0, 1);
  for (int symbol = 0; symbol < alphabet; ++symbol) out.write(symbol < 256 ? 1 : 0, 1);
}

/// Codes stand with their most significant bit first.
void writeByte(BitWriter& out, std::uint8_t value) {
  for (int bit = 7; bit >= 0; --bit) out.write(value >> bit & 1u, 1);
}

} // namespace

Bytes webpChunk(std::string_view type, const Bytes& payload) {
  Bytes chunk(type.begin(), type.end());
  appendNumber(chunk, payload.size(), 4);
  append(chunk, payload);
  if (payload.size() % 2 != 0) chunk.push_back(0);
  return chunk;
}

Bytes webpFile(const Bytes& chunks) {
  Bytes content{'W', 'E', 'B', 'P'};
  append(content, chunks);
  return webpChunk("RIFF", content);
}

Bytes webpCanvas(std::uint8_t flags, std::uint32_t width, std::uint32_t height) {
  Bytes canvas{flags, 0, 0, 0};
  appendNumber(canvas, width - 1, 3);
  appendNumber(canvas, height - 1, 3);
  return canvas;
}

Bytes losslessBitstream(int width, int height, const Bytes& rgba, bool alphaIsUsed) {
  BitWriter out;
  out.write(0x2f, 8);
  out.write(static_cast<std::uint32_t>(width - 1), 14);
  out.write(static_cast<std::uint32_t>(height - 1), 14);
  out.write(alphaIsUsed ? 1 : 0, 1);
  out.write(0, 3); // version
  out.write(0, 1); // no transform
  out.write(0, 1); // no cache of colors
  out.write(0, 1); // one group of prefix codes
  writeByteCode(out, 256 + 24);
  for (int channel = 0; channel < 3; ++channel) writeByteCode(out, 256);
  for (const std::uint32_t bit : {1u, 0u, 0u, 0u}) out.write(bit, 1); // of distances, the symbol 0 alone
  for (std::size_t pixel = 0; pixel + 4 <= rgba.size(); pixel += 4) {
    for (const std::size_t channel : {std::size_t{1}, std::size_t{0}, std::size_t{2}, std::size_t{3}}) {
      writeByte(out, rgba[pixel + channel]);
    }
  }
  return out.bytes;
}

Bytes losslessWebp(int width, int height, const Bytes& rgba, bool alphaIsUsed) {
  return webpFile(webpChunk("VP8L", losslessBitstream(width, height, rgba, alphaIsUsed)));
}

} // namespace gnomon::testing
