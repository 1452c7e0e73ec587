#include "renderer/cpu/show/show_view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "renderer/core/parallel.h"
#include "renderer/cpu/show/srgb_bytes.h"
#include "renderer/cpu/show/view_squares.h"
#include "renderer/device/view_image.h"

namespace gnomon::cpu {
namespace {

/// Turns each value of a square's pixels, of a channel, into the picture's.
template <class T, class Convert>
void writeSquare(const TileColors& colors, int x, int y, Image& image, std::vector<T>& pixels, const Convert& convert) {
  const std::size_t channels = image.channels.size();
  for (int row = 0; row < std::min(kTileSide, image.height - y); ++row) {
    const auto line = static_cast<std::size_t>(image.height - 1 - y - row) * static_cast<std::size_t>(image.width);
    T* out = &pixels[(line + static_cast<std::size_t>(x)) * channels];
    for (int column = 0; column < std::min(kTileSide, image.width - x); ++column) {
      const auto pixel = static_cast<std::size_t>((row & 12) << 4 | (column & 12) << 2 | (row & 3) << 2 | (column & 3));
      for (std::size_t c = 0; c < channels; ++c) *out++ = convert(c, colors.channels[c][pixel]);
    }
  }
}

/// Four pixels of a row: their first three channels, or all four.
void writeFour(const std::uint32_t* in, std::size_t channels, std::uint8_t* out) {
  if (channels == 4) {
    std::memcpy(out, in, 16);
    return;
  }
  const std::uint32_t rgb[4] = {in[0] & 0xffffffu, in[1] & 0xffffffu, in[2] & 0xffffffu, in[3] & 0xffffffu};
  const std::uint32_t packed[3] = {rgb[0] | rgb[1] << 24, rgb[1] >> 8 | rgb[2] << 16, rgb[2] >> 16 | rgb[3] << 8};
  std::memcpy(out, packed, sizeof packed);
}

/// The same of a square's bytes: a picture's first three channels, or all four. (Bytes of a number from the lowest on.)
void writeBytes(const TileBytes& bytes, int x, int y, Image& image, std::vector<std::uint8_t>& pixels) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t channels = image.channels.size();
  const int columns = std::min(kTileSide, image.width - x);
  for (int row = 0; row < std::min(kTileSide, image.height - y); ++row) {
    const auto line = static_cast<std::size_t>(image.height - 1 - y - row) * static_cast<std::size_t>(image.width);
    std::uint8_t* out = &pixels[(line + static_cast<std::size_t>(x)) * channels];
    const std::uint32_t* in = &bytes.pixels[static_cast<std::size_t>((row & 12) << 4 | (row & 3) << 2)];
    for (int column = 0; column < columns; column += 4, in += 16, out += 4 * channels) {
      if (columns - column >= 4) {
        writeFour(in, channels, out);
      } else {
        for (int i = 0; i < columns - column; ++i)
          std::memcpy(out + static_cast<std::size_t>(i) * channels, in + i, channels);
      }
    }
  }
}

/// Calls `each(list, x, y)` with the fragments of every square of the picture.
template <class Each>
void forEachSquare(const ShowJob& job, const Each& each) {
  const auto across = static_cast<std::size_t>((job.scene.width + kTileSide - 1) / kTileSide);
  const auto up = static_cast<std::size_t>((job.scene.height + kTileSide - 1) / kTileSide);
  forEachPiece(across * up, 8, [&](std::size_t first, std::size_t last) {
    FragmentList list;
    for (std::size_t i = first; i < last; ++i) {
      const int x = static_cast<int>(i % across) * kTileSide;
      const int y = static_cast<int>(i / across) * kTileSide;
      listFragments(job.buffer, x, y, list);
      each(list, x, y);
    }
  });
}

template <class T, class Write>
void fill(const ShowJob& job, Image& image, const Write& write) {
  const bool picture = traitsOf(job.view).source == ViewSource::picture;
  std::vector<T> pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        image.channels.size());
  forEachSquare(job, [&](const FragmentList& list, int x, int y) {
    TileColors colors;
    picture ? pictureSquare(job, list, x, y, colors) : dataSquare(job, list, x, y, colors);
    write(colors, x, y, pixels);
  });
  image.pixels = std::move(pixels);
}

} // namespace

Image showView(const ShowJob& job, bool opaque) {
  Image image{job.scene.width, job.scene.height, channelsOf(job.view, job.encoded, opaque), {}};
  if (!job.encoded) {
    fill<float>(job, image, [&](const TileColors& colors, int x, int y, std::vector<float>& pixels) {
      writeSquare(colors, x, y, image, pixels, [](std::size_t, float value) { return value; });
    });
  } else if (job.fine) {
    fill<std::uint16_t>(job, image, [&](const TileColors& colors, int x, int y, std::vector<std::uint16_t>& pixels) {
      writeSquare(colors, x, y, image, pixels,
                  [&](std::size_t c, float value) { return fineWord(traitsOf(job.view), c, value); });
    });
  } else if (traitsOf(job.view).srgb) {
    fill<std::uint8_t>(job, image, [&](const TileColors& colors, int x, int y, std::vector<std::uint8_t>& pixels) {
      TileBytes bytes;
      srgbBytes(colors, bytes);
      writeBytes(bytes, x, y, image, pixels);
    });
  } else {
    fill<std::uint8_t>(job, image, [&](const TileColors& colors, int x, int y, std::vector<std::uint8_t>& pixels) {
      writeSquare(colors, x, y, image, pixels, [](std::size_t, float value) { return unormByte(value); });
    });
  }
  return image;
}

} // namespace gnomon::cpu
