#include "renderer/passes/views/read_back.h"

#include <algorithm>
#include <cstring>

#include "renderer/core/parallel.h"
#include "renderer/core/vectors.h"
#include "renderer/device/view_image.h"
#include "renderer/prepare/named_tiles.h"

namespace gnomon {
namespace {

/// The first `channels` of four. All four are written where the row has room for them; the next pixel's go over those
/// that are not wanted.
template <class T>
void pickRow(const T* rgba, std::size_t pixels, std::size_t channels, T* to) {
  std::size_t x = 0;
  for (; x * channels + 4 <= pixels * channels; ++x) std::memcpy(to + x * channels, rgba + x * 4, 4 * sizeof(T));
  for (; x < pixels; ++x) std::copy_n(rgba + x * 4, channels, to + x * channels);
}

/// The first `channels` of four, rows turned over.
template <class T>
std::vector<T> picked(const UnfilledVector<T>& rgba, std::size_t width, std::size_t height, std::size_t channels) {
  std::vector<T> out(width * height * channels);
  forEachPiece(height, 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y) {
      pickRow(rgba.data() + (height - 1 - y) * width * 4, width, channels, out.data() + y * width * channels);
    }
  });
  return out;
}

template <class T>
std::vector<T> readPicked(const DrawnView& drawn, GLenum type, std::size_t channels) {
  const gl::TextureShape& shape = drawn.color.shape();
  const auto width = static_cast<std::size_t>(shape.width);
  const auto height = static_cast<std::size_t>(shape.height);
  UnfilledVector<T> rgba(width * height * 4);
  drawn.framebuffer.readColor(0, {0, 0, shape.width, shape.height}, {GL_RGBA, type},
                              std::as_writable_bytes(std::span(rgba)));
  return picked(rgba, width, height, channels);
}

/// A rectangle of the atlas, first row on top: grey when encoded, else the depths as they are.
Image depthsIn(const gl::Texture& atlas, const Rect& rect, const ViewRequest& request) {
  std::vector<float> depths(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  const GLenum format = atlas.shape().format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
  atlas.read(0, rect, {format, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  return depthImage(rect.width, rect.height, depths, request.encoded, request.fine);
}

std::vector<std::uint16_t> fineWords(View view, const std::vector<float>& linear, std::size_t channels) {
  std::vector<std::uint16_t> words(linear.size());
  forEachPiece(linear.size() / channels, 16384, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first * channels; i < last * channels; ++i) {
      words[i] = fineWord(traitsOf(view), i % channels, linear[i]);
    }
  });
  return words;
}

} // namespace

Image readView(const DrawnView& drawn, const ViewRequest& request) {
  Image image{drawn.color.width(), drawn.color.height(), channelsOf(request.view, request.encoded, request.opaque), {}};
  const std::size_t channels = image.channels.size();
  if (request.encoded && !request.fine) {
    image.pixels = readPicked<std::uint8_t>(drawn, GL_UNSIGNED_BYTE, channels);
    return image;
  }
  auto linear = readPicked<float>(drawn, GL_FLOAT, channels);
  if (request.encoded) {
    image.pixels = fineWords(request.view, linear, channels);
  } else {
    image.pixels = std::move(linear);
  }
  return image;
}

Image readTile(const gl::Texture& depths, const ShadowTile& tile, const ViewRequest& request) {
  return depthsIn(depths, tile.rect, request);
}

Image readAtlas(const gl::Texture& depths, const ShadowPlan& plan, const ViewRequest& request) {
  Image image = depthsIn(depths, {0, 0, depths.width(), depths.height()}, request);
  return request.encoded ? namedTiles(image, plan) : image;
}

} // namespace gnomon
