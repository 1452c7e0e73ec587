// "Portable Network Graphics (PNG) Specification", W3C.
#include <algorithm>
#include <array>
#include <cstring>
#include <libdeflate.h>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/core/stop.h"
#include "renderer/image/image_container.h"
#include "renderer/image/picture_decode.h"
#include "renderer/image/png_rows.h"

namespace gnomon {
namespace {

struct PngChunk {
  std::string_view type;
  EncodedBytes data;
  EncodedBytes whole; ///< with length, type and checksum
};

/// What the file says of its pixels, and where they are.
struct Contents {
  PngPixels pixels;
  bool interlaced = false;
  std::vector<EncodedBytes> compressed;
};

/// The chunks of a file, of which the last may be cut short.
std::vector<PngChunk> chunksOf(EncodedBytes file) {
  std::vector<PngChunk> chunks;
  for (std::size_t at = kPngSignature.size(); at < file.size();) {
    const std::size_t length = bigEndian(file, at, 4);
    const EncodedBytes left = file.subspan(at + 4);
    const EncodedBytes checked = left.first(std::min(left.size(), 4 + length));
    const EncodedBytes whole = file.subspan(at, std::min(file.size() - at, kPngFrameBytes + length));
    chunks.push_back({{reinterpret_cast<const char*>(checked.data()), 4}, checked.subspan(4), whole});
    at += kPngFrameBytes + length;
  }
  return chunks;
}

/// A chunk without a checksum is wrong.
bool checksumHolds(const PngChunk& chunk) {
  const std::size_t length = bigEndian(chunk.whole, 0, 4);
  return chunk.whole.size() == kPngFrameBytes + length &&
         libdeflate_crc32(0, chunk.whole.data() + 4, 4 + length) == bigEndian(chunk.whole, 8 + length, 4);
}

/// The spec's table 11.1.
bool isAllowed(const PngPixels& pixels) {
  const int depth = pixels.bitDepth;
  const bool byte = depth == 8 || depth == 16;
  switch (pixels.colorType) {
    case 0:
      return byte || depth == 1 || depth == 2 || depth == 4;
    case 3:
      return depth == 1 || depth == 2 || depth == 4 || depth == 8;
    case 2:
    case 4:
    case 6:
      return byte;
    default:
      return false;
  }
}

void readPalette(EncodedBytes colors, PngPixels& pixels) {
  pixels.palette.assign(256, {0, 0, 0, 255});
  for (std::size_t i = 0; i < std::min<std::size_t>(colors.size() / 3, 256); ++i) {
    std::copy_n(colors.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, pixels.palette[i].begin());
  }
}

void readTransparency(EncodedBytes values, PngPixels& pixels) {
  if (pixels.colorType == 3) {
    for (std::size_t i = 0; i < std::min(values.size(), pixels.palette.size()); ++i) pixels.palette[i][3] = values[i];
  }
  const std::size_t channels = pixels.colorType == 0 ? 1 : pixels.colorType == 2 ? 3 : 0;
  if (channels == 0 || values.size() != 2 * channels) return;
  std::array<std::uint16_t, 3> color{};
  const std::uint32_t mask = (1u << pixels.bitDepth) - 1;
  for (std::size_t i = 0; i < channels; ++i) color[i] = static_cast<std::uint16_t>(bigEndian(values, 2 * i, 2) & mask);
  pixels.transparent = color;
}

/// Why there is no picture; empty = there is.
std::string read(const std::vector<PngChunk>& chunks, Contents& contents) {
  PngPixels& pixels = contents.pixels;
  for (const PngChunk& chunk : chunks) {
    const bool before = contents.compressed.empty();
    if (chunk.type == "IHDR") {
      if (&chunk != &chunks.front() || chunk.data.size() != kPngHeaderBytes) {
        return "its header is not where it belongs";
      }
      pixels.bitDepth = chunk.data[8];
      pixels.colorType = chunk.data[9];
      if (!isAllowed(pixels) || chunk.data[10] != 0 || chunk.data[11] != 0 || chunk.data[12] > 1) {
        return "its header asks for what PNG does not have";
      }
      contents.interlaced = chunk.data[12] == 1;
    } else if (chunk.type == "PLTE" && before && pixels.colorType == 3) {
      if (chunk.data.empty() || chunk.data.size() % 3 != 0 || chunk.data.size() > 768) return "its palette is broken";
      readPalette(chunk.data, pixels);
    } else if (chunk.type == "tRNS" && before) {
      readTransparency(chunk.data, pixels);
    } else if (chunk.type == "IDAT") {
      contents.compressed.push_back(chunk.data);
    }
  }
  if (pixels.colorType == 3 && pixels.palette.empty()) return "it has no palette";
  return contents.compressed.empty() ? "it has no pixels" : "";
}

/// Pixels that are stored together: every `step`th of the picture from `first` on, in both directions.
struct Pass {
  std::size_t firstX, firstY, stepX, stepY;
};
constexpr std::array<Pass, 1> kWhole{{{0, 0, 1, 1}}};
constexpr std::array<Pass, 7> kAdam7{
    {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};

constexpr std::size_t stepsIn(std::size_t size, std::size_t first, std::size_t step) {
  return size > first ? (size - first + step - 1) / step : 0;
}

void clearFrom(std::size_t row, DecodedRows& to) {
  for (int y = static_cast<int>(row); y < to.size().height; ++y) {
    std::memset(to.at(y), 0, to.rowBytes());
    to.complete(y + 1);
  }
}

} // namespace

std::string unreadablePng(EncodedBytes essential) {
  Contents contents;
  return read(chunksOf(essential), contents);
}

std::string decodePng(EncodedBytes essential, DecodedRows& to) {
  const std::vector<PngChunk> chunks = chunksOf(essential);
  const std::string checksums = std::ranges::all_of(chunks, checksumHolds) ? "" : "a checksum is wrong";
  Contents contents;
  read(chunks, contents);
  const auto width = static_cast<std::size_t>(to.size().width);
  const auto height = static_cast<std::size_t>(to.size().height);
  const std::size_t bits = contents.pixels.bits();
  const std::size_t pixelBytes = std::max<std::size_t>(bits / 8, 1);
  InflatedRows rows(contents.compressed);
  std::vector<std::uint8_t> line(4 * width);
  if (contents.interlaced) std::memset(to.all(), 0, to.rowBytes() * height);
  const std::span<const Pass> passes = contents.interlaced ? std::span<const Pass>(kAdam7) : kWhole;
  for (const Pass& pass : passes) {
    const std::size_t columns = stepsIn(width, pass.firstX, pass.stepX);
    const std::size_t lines = columns > 0 ? stepsIn(height, pass.firstY, pass.stepY) : 0;
    rows.begin((columns * bits + 7) / 8, pixelBytes, lines);
    for (std::size_t i = 0; i < lines; ++i) {
      if (i % DecodedRows::kStep == 0) stopIfAsked();
      const std::uint8_t* row = rows.next();
      if (row == nullptr) {
        if (contents.interlaced) {
          to.complete(to.size().height);
        } else {
          clearFrom(i, to);
        }
        return checksums.empty() ? rows.wrong() : checksums;
      }
      std::uint8_t* place = to.at(static_cast<int>(pass.firstY + i * pass.stepY));
      if (pass.stepX == 1) {
        expandRow(contents.pixels, row, columns, place);
        if (!contents.interlaced) to.complete(static_cast<int>(i + 1));
        continue;
      }
      expandRow(contents.pixels, row, columns, line.data());
      for (std::size_t x = 0; x < columns; ++x) {
        std::memcpy(place + 4 * (pass.firstX + x * pass.stepX), &line[4 * x], 4);
      }
    }
  }
  if (contents.interlaced) to.complete(to.size().height);
  return checksums;
}

} // namespace gnomon
