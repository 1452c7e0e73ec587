#include <gtest/gtest.h>
#include <limits>

#include "renderer/export/export_files.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "renderer/scene/scene.h"

namespace gnomon {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Frame frameOf(View view, int width, std::vector<float> numbers) {
  Frame frame;
  const int height = static_cast<int>(numbers.size()) / width;
  frame.images.push_back({view, Image{width, height, {"Z"}, std::move(numbers)}});
  return frame;
}

TEST(Labels, AreColorsAsTheFileHasThem) {
  Scene scene;
  scene.materials.resize(256);
  for (int i = 0; i < 256; ++i) {
    scene.materials[static_cast<std::size_t>(i)].baseColorFactor = {float(i / 255.0), float((255 - i) / 255.0), 0, 1};
  }
  std::vector<float> materials(256);
  for (int i = 0; i < 256; ++i) materials[static_cast<std::size_t>(i)] = static_cast<float>(i);
  materials[7] = -1;
  const auto png = labelPng(scene, frameOf(View::materials, 16, materials));
  ASSERT_TRUE(png);
  const auto image = decodeImage(*png, 64, 4096);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 16);
  const auto& pixels = std::get<std::vector<std::uint8_t>>(image->pixels);
  for (std::size_t i = 0; i < 256; ++i) {
    const std::vector<std::uint8_t> pixel(pixels.begin() + 4 * static_cast<std::ptrdiff_t>(i),
                                          pixels.begin() + 4 * static_cast<std::ptrdiff_t>(i) + 3);
    const auto label = static_cast<std::uint8_t>(i);
    EXPECT_EQ(pixel, i == 7 ? std::vector<std::uint8_t>(3, 255)
                            : (std::vector<std::uint8_t>{label, static_cast<std::uint8_t>(255 - label), 0}));
  }
}

TEST(Depths, BeyondTheSensorAreZeroAndInfinity) {
  // Equal pictures are equal files, so that the file of what is expected tells.
  const SensorRange range{1, 2};
  const auto sensed = depthTiff(frameOf(View::depth, 3, {0.5f, 1, 1.5f, 2, 2.5f, kInfinity}), range);
  const auto expected = depthTiff(frameOf(View::depth, 3, {0, 1, 1.5f, 2, kInfinity, kInfinity}),
                                  {0, std::numeric_limits<double>::max()});
  ASSERT_TRUE(sensed && expected);
  EXPECT_EQ(*sensed, *expected);
}

TEST(Depths, InMillimetresAreWholeNumbers) {
  const auto millimetres = [](std::vector<std::uint16_t> numbers) {
    const int width = static_cast<int>(numbers.size());
    return *encodePng(Image{width, 1, {"Y"}, std::move(numbers)}, Output{}.pngCompression);
  };
  const auto sensed =
      depthPng(frameOf(View::depth, 6, {0.05f, 0.1f, 1.2344f, 65.5f, 70, kInfinity}), SensorRange{0.1, 100});
  ASSERT_TRUE(sensed);
  EXPECT_EQ(*sensed, millimetres({0, 100, 1234, 65500, 65535, 65535}));
}

} // namespace
} // namespace gnomon
