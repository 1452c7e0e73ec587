#include "renderer/cpu/show/show_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/cpu/show/srgb_bytes.h"
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
      const auto pixel = static_cast<std::size_t>(pixelAt(column, row));
      for (std::size_t c = 0; c < channels; ++c) *out++ = convert(c, colors.channels[c][pixel]);
    }
  }
}

/// The same of bytes.
template <std::size_t channels>
void writeBytes(const TileBytes& bytes, int x, int y, Image& image, std::vector<std::uint8_t>& pixels) {
  const int columns = std::min(kTileSide, image.width - x);
  for (int row = 0; row < std::min(kTileSide, image.height - y); ++row) {
    const auto line = static_cast<std::size_t>(image.height - 1 - y - row) * static_cast<std::size_t>(image.width);
    std::uint8_t* out = &pixels[(line + static_cast<std::size_t>(x)) * channels];
    const std::uint8_t* in = &bytes.pixels[static_cast<std::size_t>(4 * pixelAt(0, row))];
    int left = columns;
    for (; left >= 4; left -= 4, in += 64, out += 4 * channels) std::memcpy(out, in, 4 * channels);
    if (left > 0) std::memcpy(out, in, static_cast<std::size_t>(left) * channels);
  }
}

/// `turned`: what is written of a square's colors.
template <class T, class Turn, class Write>
void fill(const ShowJob& job, Image& image, const Turn& turned, const Write& write) {
  const bool picture = traitsOf(job.view).source == ViewSource::picture;
  std::vector<T> pixels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        image.channels.size());
  const auto square = [&](const FragmentList& list, int x, int y) {
    TileColors colors;
    picture ? pictureSquare(job, list, x, y, colors) : dataSquare(job, list, x, y, colors);
    return turned(colors);
  };
  const bool alike = picture && isPlainBehind(job); // squares that show no surface
  const auto background = square(FragmentList{}, 0, 0);
  forEachSquare(job.buffer, [&](const FragmentList& list, int x, int y) {
    if (alike && list.count == 0) {
      write(background, x, y, pixels);
    } else {
      write(square(list, x, y), x, y, pixels);
    }
  });
  image.pixels = std::move(pixels);
}

/// The same, each channel by itself.
template <class T, class Convert>
void fillEach(const ShowJob& job, Image& image, const Convert& convert) {
  fill<T>(
      job, image, [](const TileColors& colors) { return colors; },
      [&](const TileColors& colors, int x, int y, std::vector<T>& pixels) {
        writeSquare(colors, x, y, image, pixels, convert);
      });
}

} // namespace

Image showView(const ShowJob& job, bool opaque) {
  Image image{job.scene.width, job.scene.height, channelsOf(job.view, job.encoded, opaque), {}};
  const ViewTraits& traits = traitsOf(job.view);
  if (!job.encoded) {
    fillEach<float>(job, image, [](std::size_t, float value) { return value; });
  } else if (job.fine) {
    fillEach<std::uint16_t>(job, image, [&](std::size_t c, float value) { return fineWord(traits, c, value); });
  } else if (traits.srgb) {
    const std::size_t channels = image.channels.size();
    fill<std::uint8_t>(
        job, image, [&](const TileColors& colors) { return srgbBytes(colors, channels); },
        [&](const TileBytes& bytes, int x, int y, std::vector<std::uint8_t>& pixels) {
          channels == 4 ? writeBytes<4>(bytes, x, y, image, pixels) : writeBytes<3>(bytes, x, y, image, pixels);
        });
  } else {
    fillEach<std::uint8_t>(job, image, [](std::size_t, float value) { return unormByte(value); });
  }
  return image;
}

} // namespace gnomon::cpu
