#include "renderer/techniques/baked_shadow.h"

#include "renderer/techniques/picture_shares.h"

namespace gnomon {
namespace {

/// Looks up the samples that wait, and puts what is found where the picture's shares are. None wait any more.
void lookUp(const PicturePoints& points, const BakedLight& baked, ShownSamples& waiting, std::uint16_t* shares) {
  const SampleGrid& grid = points.grid();
  const DrawnPlaces places = points.drawn(waiting);
  const DrawnWeights at = points.weights(places);
  for (std::size_t i = 0; i < waiting.count; ++i) {
    const glm::vec2* corner = baked.layout->cornersOf(places.shown[i]);
    const glm::vec2 place = corner[0] + at.u[i] * (corner[1] - corner[0]) + at.v[i] * (corner[2] - corner[0]);
    shares[grid.numberOf(waiting.pixels[i]) * grid.samples() + waiting.samples[i]] = unorm16(shareAt(baked.map, place));
  }
  waiting.count = 0;
}

} // namespace

TracedShadow bakedShadow(const PicturePoints& points, const BakedLight& baked) {
  const SampleGrid& grid = points.grid();
  UnfilledVector<std::uint16_t> shares(grid.pixels() * grid.samples() + 1); // read by pairs
  forEachBlock(grid, [&](const Rect& block) {
    ShownSamples waiting;
    forEachPixel(grid, block, [&](const glm::ivec2& pixel) {
      for (std::uint32_t sample = 0; sample < grid.samples(); ++sample) {
        const std::uint32_t number = points.numberAt(pixel, sample);
        if (number == kNoNumber) {
          shares[grid.numberOf(pixel) * grid.samples() + sample] = 65535;
          continue;
        }
        waiting.add(pixel, sample, number);
        if (waiting.full()) lookUp(points, baked, waiting, shares.data());
      }
    });
    if (waiting.count > 0) lookUp(points, baked, waiting, shares.data());
  });
  shares.resize(grid.pixels() * grid.samples());
  return {std::move(shares), {}};
}

} // namespace gnomon
