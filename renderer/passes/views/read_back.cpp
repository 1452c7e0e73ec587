#include "renderer/passes/views/read_back.h"

#include "renderer/device/view_image.h"
#include "renderer/prepare/named_tiles.h"

namespace gnomon {
namespace {

/// The first `channels` of four, rows turned over.
template <class T>
std::vector<T> picked(const std::vector<T>& rgba, std::size_t width, std::size_t height, std::size_t channels) {
  std::vector<T> out(width * height * channels);
  for (std::size_t y = 0; y < height; ++y) {
    const T* from = rgba.data() + (height - 1 - y) * width * 4;
    T* to = out.data() + y * width * channels;
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < channels; ++c) to[x * channels + c] = from[x * 4 + c];
    }
  }
  return out;
}

template <class T>
std::vector<T> readPicked(const DrawnView& drawn, GLenum type, std::size_t channels) {
  const gl::TextureShape& shape = drawn.color.shape();
  const auto width = static_cast<std::size_t>(shape.width);
  const auto height = static_cast<std::size_t>(shape.height);
  std::vector<T> rgba(width * height * 4);
  drawn.framebuffer.readColor(0, {0, 0, shape.width, shape.height}, {GL_RGBA, type},
                              std::as_writable_bytes(std::span(rgba)));
  return picked(rgba, width, height, channels);
}

/// A rectangle of the atlas, first row on top: grey when encoded, else the depths as they are.
Image depthsIn(const gl::Texture& atlas, const Rect& rect, bool encoded) {
  std::vector<float> depths(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  const GLenum format = atlas.shape().format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
  atlas.read(0, rect, {format, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  return depthImage(rect.width, rect.height, depths, encoded);
}

} // namespace

Image readView(const DrawnView& drawn, View view, bool encoded, bool opaque) {
  Image image{drawn.color.width(), drawn.color.height(), channelsOf(view, encoded, opaque), {}};
  if (encoded) {
    image.pixels = readPicked<std::uint8_t>(drawn, GL_UNSIGNED_BYTE, image.channels.size());
  } else {
    image.pixels = readPicked<float>(drawn, GL_FLOAT, image.channels.size());
  }
  return image;
}

Image readTile(const gl::Texture& depths, const ShadowTile& tile, bool encoded) {
  return depthsIn(depths, tile.rect, encoded);
}

Image readAtlas(const gl::Texture& depths, const ShadowPlan& plan, bool encoded) {
  Image image = depthsIn(depths, {0, 0, depths.width(), depths.height()}, encoded);
  return encoded ? namedTiles(image, plan) : image;
}

} // namespace gnomon
