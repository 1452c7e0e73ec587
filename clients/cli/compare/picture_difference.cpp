#include "clients/cli/compare/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <variant>
#include <vector>

#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

constexpr std::size_t kChannels = 4;

const std::uint8_t* bytesOf(const Image& picture) {
  return std::get<std::vector<std::uint8_t>>(picture.pixels).data();
}

/// 0..255, of the pixel of this index.
int pixelDifference(const Image& a, const Image& b, std::size_t pixel) {
  int largest = 0;
  for (std::size_t at = pixel * kChannels; at < (pixel + 1) * kChannels; ++at) {
    largest = std::max(largest, std::abs(int(bytesOf(a)[at]) - int(bytesOf(b)[at])));
  }
  return largest;
}

bool isBeyond(int difference, double threshold) {
  return difference / 255.0 > threshold;
}

std::size_t pixelCount(const Image& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

std::string sizeText(const Image& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

} // namespace

Result<Image> decodePicture(std::span<const std::uint8_t> file, const std::string& name) {
  auto picture = decodeImage(file, kLimits.maxFrameSide, kLimits.maxFramePixels);
  if (picture) return picture;
  Problems problems = picture.problems();
  for (Problem& problem : problems) problem.pointer = name;
  return problems;
}

Result<PictureDifference> differenceOf(const Image& a, const Image& b, double threshold) {
  if (a.width != b.width || a.height != b.height) {
    return Problem{ProblemCode::invalidValue, "", "The pictures differ in size.", sizeText(a), sizeText(b)};
  }
  PictureDifference result;
  result.pixels = static_cast<std::int64_t>(pixelCount(a));
  std::int64_t sum = 0;
  int largest = 0;
  for (std::size_t pixel = 0; pixel < pixelCount(a); ++pixel) {
    const int difference = pixelDifference(a, b, pixel);
    sum += difference;
    result.beyond += isBeyond(difference, threshold);
    if (difference <= largest) continue;
    largest = difference;
    result.worstX = static_cast<int>(pixel % static_cast<std::size_t>(a.width));
    result.worstY = static_cast<int>(pixel / static_cast<std::size_t>(a.width));
  }
  result.largest = largest / 255.0;
  result.mean = static_cast<double>(sum) / 255.0 / static_cast<double>(result.pixels);
  return result;
}

Result<Bytes> differencePicture(const Image& a, const Image& b, double threshold) {
  int largest = 1;
  for (std::size_t pixel = 0; pixel < pixelCount(a); ++pixel) largest = std::max(largest, pixelDifference(a, b, pixel));
  std::vector<std::uint8_t> pixels;
  pixels.reserve(pixelCount(a) * 3);
  for (std::size_t pixel = 0; pixel < pixelCount(a); ++pixel) {
    const int difference = pixelDifference(a, b, pixel);
    const auto level = static_cast<std::uint8_t>(difference * 255 / largest);
    // Never darker than what can be seen: one level off counts, too.
    const auto red = static_cast<std::uint8_t>(difference > 0 ? std::max<int>(level, 96) : 0);
    const std::uint8_t rest = isBeyond(difference, threshold) ? 0 : level;
    pixels.insert(pixels.end(), {isBeyond(difference, threshold) ? red : level, rest, rest});
  }
  return encodePng(Image{a.width, a.height, {"R", "G", "B"}, std::move(pixels)}, 2);
}

std::string differenceText(const PictureDifference& difference, double threshold) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "largest %.4g at %d,%d, mean %.4g, beyond %g: %lld of %lld pixels",
                difference.largest, difference.worstX, difference.worstY, difference.mean, threshold,
                static_cast<long long>(difference.beyond), static_cast<long long>(difference.pixels));
  return text.data();
}

} // namespace gnomon::cli
