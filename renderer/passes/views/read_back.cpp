#include "renderer/passes/views/read_back.h"

#include <algorithm>
#include <cmath>

#include "protocol/spec/view_traits.h"
#include "renderer/prepare/named_tiles.h"

namespace gnomon {
namespace {

std::vector<std::string> channelsOf(View view, bool encoded, bool opaque) {
  const ViewTraits& traits = traitsOf(view);
  std::vector<std::string> channels;
  for (const std::string_view name : encoded ? traits.png : traits.exr) {
    if (!name.empty()) channels.emplace_back(name);
  }
  if (traits.source == ViewSource::picture && !opaque) channels.emplace_back("A");
  return channels;
}

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
Image depthImage(const gl::Texture& atlas, const Rect& rect, bool encoded) {
  Image image{rect.width, rect.height, {encoded ? "Y" : "Z"}, {}};
  const auto width = static_cast<std::size_t>(rect.width);
  const auto height = static_cast<std::size_t>(rect.height);
  std::vector<float> depths(width * height);
  const GLenum format = atlas.shape().format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
  atlas.read(0, rect, {format, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  std::vector<float> turned(depths.size());
  for (std::size_t y = 0; y < height; ++y) {
    std::copy_n(depths.data() + (height - 1 - y) * width, width, turned.data() + y * width);
  }
  if (!encoded) {
    image.pixels = std::move(turned);
    return image;
  }
  std::vector<std::uint8_t> grey(turned.size());
  std::transform(turned.begin(), turned.end(), grey.begin(),
                 [](float depth) { return static_cast<std::uint8_t>(std::lround(depth * 255.0f)); });
  image.pixels = std::move(grey);
  return image;
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
  return depthImage(depths, tile.rect, encoded);
}

Image readAtlas(const gl::Texture& depths, const ShadowPlan& plan, bool encoded) {
  Image image = depthImage(depths, {0, 0, depths.width(), depths.height()}, encoded);
  return encoded ? namedTiles(image, plan) : image;
}

} // namespace gnomon
