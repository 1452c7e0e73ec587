#include "renderer/techniques/penumbras.h"

#include "renderer/core/parallel.h"
#include "renderer/techniques/neighbours.h"

namespace gnomon {
namespace {

/// Rays that every pixel has been given when a round ends, and those that the next one brings it to.
struct Round {
  int number = 0; ///< of rounds before it
  std::uint32_t first = 1, last = 1;
};

/// Adds what the rays of a round see to what was seen before. None wait any more.
void add(const PicturePoints& points, const TracedLight& light, const Round& round, ShownSamples& waiting,
         PictureShares& shares) {
  float found[DrawnPlaces::kCount];
  std::uint8_t away[DrawnPlaces::kCount];
  light.visibility(points.drawn(waiting), round.first, round.last, found, away);
  const float before = static_cast<float>(round.first) / static_cast<float>(round.last);
  for (std::size_t i = 0; i < waiting.count; ++i) {
    const std::uint32_t pixel = shares.grid.numberOf(waiting.pixels[i]);
    const float known = static_cast<float>(*shares.valuesOf(pixel)) / 65535.0f;
    shares.set(pixel, before * known + (1 - before) * found[i]);
  }
  waiting.count = 0;
}

/// From all of `pixels`, which are of this round.
void trace(const PicturePoints& points, const TracedLight& light, const Round& round, const Pixels& pixels,
           PictureShares& shares) {
  const int columns = blockColumns(shares.grid);
  Pixels blocks;
  for (const std::uint32_t pixel : pixels) {
    shares.marks[pixel] |= PictureShares::kAsked;
    const glm::ivec2 at = shares.grid.pixelAt(pixel);
    const auto block = static_cast<std::uint32_t>(at.y / kBlockHeight * columns + at.x / kBlockWidth);
    if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
  }
  blocks = eachOnce(std::move(blocks));
  forEach(blocks.size(), [&](std::size_t i) {
    ShownSamples waiting;
    forEachPixel(shares.grid, blockOf(shares.grid, blocks[i]), [&](const glm::ivec2& pixel) {
      std::uint8_t& mark = shares.marks[shares.grid.numberOf(pixel)];
      if ((mark & PictureShares::kAsked) == 0) return;
      mark = static_cast<std::uint8_t>(mark - PictureShares::kAsked + PictureShares::kRound);
      waiting.add(pixel, 0, points.numberAt(pixel));
      if (waiting.full()) add(points, light, round, waiting, shares);
    });
    if (waiting.count > 0) add(points, light, round, waiting, shares);
  });
}

} // namespace

void tracePenumbras(const PicturePoints& points, const TracedLight& light, int samples, PictureShares& shares) {
  const auto most = static_cast<std::uint32_t>(std::max(samples, 1));
  const auto isOf = [&](const Round& round, std::uint32_t pixel) {
    const std::uint8_t mark = shares.marks[pixel];
    return mark / PictureShares::kRound == round.number && (mark & PictureShares::kAway) == 0 &&
           points.numberAt(shares.grid.pixelAt(pixel)) != kNoNumber;
  };
  for (Round round; round.last < most; ++round.number) {
    round.first = round.last;
    round.last = std::min(4 * round.first, most);
    Pixels next = pixelsWhere(shares.grid, shares.shares, [](std::uint8_t least, std::uint8_t highest) {
      return static_cast<int>(highest) - static_cast<int>(least) >= kEdge;
    });
    const auto isAsked = [&](std::uint32_t pixel, std::uint32_t /*beside*/) { return isOf(round, pixel); };
    if (round.number > 0) {
      std::erase_if(next, [&](std::uint32_t pixel) { return !isOf(round, pixel); });
      trace(points, light, round, next, shares);
      continue;
    }
    for (next = pixelsBeside(shares, next, isAsked); !next.empty();) {
      trace(points, light, round, next, shares);
      // More rays may have found what a single one missed, and at the rim of a penumbra they may miss it, too.
      next = pixelsBeside(shares, next, [&](std::uint32_t pixel, std::uint32_t traced) {
        return shares.apart(pixel, traced) >= kEdge;
      });
      next = pixelsBeside(shares, next, isAsked);
    }
  }
}

} // namespace gnomon
