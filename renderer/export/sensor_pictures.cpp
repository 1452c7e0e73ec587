#include "renderer/export/sensor_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/image/png_encode.h"
#include "renderer/image/tiff_encode.h"
#include "renderer/scene/scene.h"

namespace gnomon {
namespace {

const std::vector<float>& numbersOf(const Frame& frame) {
  return std::get<std::vector<float>>(frame.images.front().image.pixels);
}

Image imageLike(const Frame& frame, std::vector<std::string> channels) {
  const Image& shown = frame.images.front().image;
  return {shown.width, shown.height, std::move(channels), {}};
}

float sensed(float depth, const SensorRange& range) {
  if (!(depth <= range.max)) return std::numeric_limits<float>::infinity();
  return depth < range.min ? 0.0f : depth;
}

std::uint16_t millimetres(float depth) {
  constexpr float kTooFar = 65535;
  return static_cast<std::uint16_t>(std::min(std::round(depth * 1000.0f), kTooFar));
}

using Rgb = std::array<std::uint8_t, 3>;

std::vector<Rgb> labelColors(const Scene& scene) {
  std::vector<Rgb> colors;
  for (const Material& material : scene.materials) {
    Rgb color{};
    for (int i = 0; i < 3; ++i) {
      color[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(std::clamp(material.baseColorFactor[i], 0.0f, 1.0f) * 255.0f));
    }
    colors.push_back(color);
  }
  return colors;
}

} // namespace

Result<Bytes> depthTiff(const Frame& frame, const SensorRange& range, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    Image image = imageLike(frame, {"Z"});
    std::vector<float> depths = numbersOf(frame);
    for (float& depth : depths) depth = sensed(depth, range);
    image.pixels = std::move(depths);
    return encodeTiff(image);
  });
}

Result<Bytes> depthPng(const Frame& frame, const SensorRange& range, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    Image image = imageLike(frame, {"Y"});
    std::vector<std::uint16_t> depths;
    depths.reserve(numbersOf(frame).size());
    for (const float depth : numbersOf(frame)) depths.push_back(millimetres(sensed(depth, range)));
    image.pixels = std::move(depths);
    return encodePng(image, frame.report.spec.output.pngCompression);
  });
}

Result<Bytes> labelPng(const Scene& scene, const Frame& frame, const GoOn& goOn) {
  return untilStopped(goOn, [&] {
    const std::vector<Rgb> colors = labelColors(scene);
    Image image = imageLike(frame, {"R", "G", "B"});
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * numbersOf(frame).size());
    for (const float material : numbersOf(frame)) {
      const Rgb color = material < 0 ? Rgb{255, 255, 255} : colors[static_cast<std::size_t>(material)];
      pixels.insert(pixels.end(), color.begin(), color.end());
    }
    image.pixels = std::move(pixels);
    return encodePng(image, frame.report.spec.output.pngCompression);
  });
}

} // namespace gnomon
