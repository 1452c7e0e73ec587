// How long PNGs take to write and how large they are at each level, against the serial way of libpng (OpenImageIO, zlib
// level 2, filter Sub) measured in the same run: both take turns. Prints a table of each picture.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

constexpr int kLevels = 10;

struct Cost {
  double milliseconds = 0;
  double bytes = 0;
};

template <class Encode>
Cost costOf(Encode encode) {
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t bytes = encode();
  const auto passed = std::chrono::steady_clock::now() - begin;
  return {std::chrono::duration<double, std::milli>(passed).count(), static_cast<double>(bytes)};
}

/// The least time: whatever else runs can only add to it. The bytes are the same each time.
Cost least(const std::vector<Cost>& costs) {
  return *std::min_element(costs.begin(), costs.end(),
                           [](const Cost& a, const Cost& b) { return a.milliseconds < b.milliseconds; });
}

std::size_t byLibpng(const Image& image) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeUInt8);
  spec.attribute("png:compressionLevel", 2);
  spec.attribute("png:filter", 0x10);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png");
  const auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  const bool written = output && output->set_ioproxy(&memory) && output->open("picture.png", spec) &&
                       output->write_image(OIIO::TypeUInt8, pixels.data()) && output->close();
  return written ? bytes.size() : 0;
}

Image withoutAlpha(const Image& rgba) {
  std::vector<std::uint8_t> rgb;
  const auto& pixels = std::get<std::vector<std::uint8_t>>(rgba.pixels);
  for (std::size_t i = 0; i < pixels.size(); i += 4) rgb.insert(rgb.end(), {pixels[i], pixels[i + 1], pixels[i + 2]});
  return {rgba.width, rgba.height, {"R", "G", "B"}, std::move(rgb)};
}

void measure(const char* path) {
  const auto decoded = decodeImage(testing::readFile(path), 16384, 1 << 28);
  if (!decoded) {
    std::printf("%s is no picture\n", path);
    return;
  }
  const Image image = withoutAlpha(*decoded);
  std::printf("\n%s, %d x %d\n\n| level | kB | ms | of libpng's bytes | of its time |\n|---|---|---|---|---|\n", path,
              image.width, image.height);
  for (int level = 0; level < kLevels; ++level) {
    const int turns = level < 3 ? 40 : level < 8 ? 10 : 4;
    std::vector<Cost> before;
    std::vector<Cost> after;
    for (int turn = 0; turn < turns; ++turn) {
      before.push_back(costOf([&] { return byLibpng(image); }));
      after.push_back(costOf([&] { return encodePng(image, level)->size(); }));
    }
    const Cost libpng = least(before);
    const Cost ours = least(after);
    std::printf("| %d | %.0f | %.1f | %.2f | %.3f |\n", level, ours.bytes / 1000, ours.milliseconds,
                ours.bytes / libpng.bytes, ours.milliseconds / libpng.milliseconds);
  }
}

} // namespace
} // namespace gnomon::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::puts("usage: bench_png PICTURE...");
    return 2;
  }
  for (int i = 1; i < argc; ++i) gnomon::bench::measure(argv[i]);
  return 0;
}
