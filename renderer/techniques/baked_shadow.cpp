#include <algorithm>

#include "renderer/techniques/picture_shares.h"
#include "renderer/techniques/traced_shadow.h"

namespace gnomon {
namespace {

constexpr int kPacketSide = 4; ///< pixels along a side: a packet's

std::uint16_t shareAtPlace(const LightMap& map, const glm::vec2& place) {
  return static_cast<std::uint16_t>(scaledShareAt(map, place) + 0.5f);
}

/// Looks up the samples that wait, and puts what is found where the picture's shares are. None wait any more.
void lookUp(const PicturePoints& points, const BakedLight& baked, ShownSamples& waiting, std::uint16_t* shares) {
  const SampleGrid& grid = points.grid();
  const DrawnPlaces places = points.drawn(waiting);
  const DrawnWeights at = points.weights(places);
  for (std::size_t i = 0; i < waiting.count; ++i) {
    const glm::vec2* corner = baked.layout->cornersOf(places.shown[i]);
    const glm::vec2 place = corner[0] + at.u[i] * (corner[1] - corner[0]) + at.v[i] * (corner[2] - corner[0]);
    shares[grid.numberOf(waiting.pixels[i]) * grid.samples() + waiting.samples[i]] = shareAtPlace(baked.map, place);
  }
  waiting.count = 0;
}

/// The same of a square whose samples all show one triangle: the middle of a pixel lies in that too, and represents all
/// of the pixel.
void lookUpSquare(const PicturePoints& points, const BakedLight& baked, const Rect& square, std::uint32_t number,
                  std::uint16_t* shares) {
  const SampleGrid& grid = points.grid();
  const std::size_t samples = grid.samples();
  ShownSamples shown;
  for (int y = square.y; y < square.y + square.height; ++y) {
    for (int x = square.x; x < square.x + square.width; ++x) shown.add({x, y}, 0, number);
  }
  if (number == kNoNumber) {
    for (const glm::ivec2& pixel : std::span(shown.pixels, shown.count)) {
      std::fill_n(shares + grid.numberOf(pixel) * samples, samples, std::uint16_t{65535});
    }
    return;
  }
  DrawnPlaces places = points.drawn(shown);
  const glm::vec2 toMiddle = samples > 1 ? 0.5f - grid.positions.front() : glm::vec2(0);
  for (std::size_t i = 0; i < shown.count; ++i) {
    places.x[i] += toMiddle.x;
    places.y[i] -= toMiddle.y; // counted from the top
  }
  const DrawnWeights at = points.weights(places);
  const glm::vec2* corner = baked.layout->cornersOf(places.shown[0]);
  const glm::vec2 second = corner[1] - corner[0], third = corner[2] - corner[0];
  for (std::size_t i = 0; i < shown.count; ++i) {
    const std::uint16_t share = shareAtPlace(baked.map, corner[0] + at.u[i] * second + at.v[i] * third);
    std::fill_n(shares + grid.numberOf(shown.pixels[i]) * samples, samples, share);
  }
}

} // namespace

TracedShadow bakedShadow(const PicturePoints& points, const BakedLight& baked) {
  const SampleGrid& grid = points.grid();
  UnfilledVector<std::uint16_t> shares(grid.pixels() * grid.samples() + 1); // read by pairs
  forEachBlock(grid, [&](const Rect& block) {
    ShownSamples waiting;
    const auto addEach = [&](const glm::ivec2& pixel) {
      for (std::uint32_t sample = 0; sample < grid.samples(); ++sample) {
        const std::uint32_t number = points.numberAt(pixel, sample);
        if (number == kNoNumber) {
          shares[grid.numberOf(pixel) * grid.samples() + sample] = 65535;
          continue;
        }
        waiting.add(pixel, sample, number);
        if (waiting.full()) lookUp(points, baked, waiting, shares.data());
      }
    };
    const int right = std::min(block.x + block.width, grid.width);
    const int top = std::min(block.y + block.height, grid.height);
    for (int y = block.y; y < top; y += kPacketSide) {
      for (int x = block.x; x < right; x += kPacketSide) {
        const Rect square{x, y, std::min(kPacketSide, right - x), std::min(kPacketSide, top - y)};
        if (const auto number = points.onlyNumberOfSamplesIn(square)) {
          lookUpSquare(points, baked, square, *number, shares.data());
        } else {
          forEachPixel(grid, square, addEach);
        }
      }
    }
    if (waiting.count > 0) lookUp(points, baked, waiting, shares.data());
  });
  shares.resize(grid.pixels() * grid.samples());
  return {std::move(shares), {}};
}

} // namespace gnomon
