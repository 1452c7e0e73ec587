#include "renderer/passes/read_back.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

std::vector<std::string> channelsOf(View view, bool encoded, bool opaque) {
  switch (view) {
    case View::color:
    case View::cascades:
      return opaque ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"R", "G", "B", "A"};
    case View::normal:
      return encoded ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"X", "Y", "Z"};
    case View::depth:
    case View::atlas:
      return {encoded ? "Y" : "Z"};
    default:
      return {"Y"};
  }
  return {};
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

Image readAtlas(const ShadowAtlas& atlas, bool encoded) {
  Image image{
      atlas.textures->depth.width(), atlas.textures->depth.height(), channelsOf(View::atlas, encoded, true), {}};
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<float> depths(width * height);
  atlas.textures->depth.read(0, {0, 0, image.width, image.height}, {GL_DEPTH_COMPONENT, GL_FLOAT},
                             std::as_writable_bytes(std::span(depths)));
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

} // namespace gnomon
