#include <algorithm>
#include <functional>
#include <iterator>
#include <span>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"
#include "renderer/core/vectors.h"
#include "renderer/techniques/neighbours.h"
#include "renderer/techniques/picture_shares.h"

namespace gnomon {
namespace {

/// The rays `first` up to `last` of a pixel.
struct Round {
  std::uint32_t first, last;
};

/// Each brings a pixel to four times as many rays as it had, the last to `most`.
std::vector<Round> roundsUpTo(std::uint32_t most) {
  std::vector<Round> rounds;
  for (std::uint32_t rays = 1; rays < most; rays = rounds.back().last) {
    rounds.push_back({rays, std::min(4 * rays, most)});
  }
  return rounds;
}

/// Adds what the rays of a round see to what was seen before. None wait any more.
void add(const PicturePoints& points, const TracedLight& light, const Round& round, ShownSamples& waiting,
         PictureShares& shares) {
  stopIfAsked();
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

/// From all of `pixels`, whose next round this is.
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
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
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

/// A byte a pixel, not 0 where first rays alone can't be trusted: where they differ on a pixel or around it, and on
/// masks, between whose leaves what shows may be a pixel large.
UnfilledVector<std::uint8_t> firstDoubts(const PicturePoints& points, const PictureShares& shares) {
  UnfilledVector<std::uint8_t> doubts = marksApart(shares.grid, shares.shares, kEdge);
  const std::span<const std::uint8_t> masks = points.masks();
  std::transform(masks.begin(), masks.end(), doubts.begin(), doubts.begin(), std::bit_or<>());
  return doubts;
}

/// The pixels that differ from one beside them, or lie beside two that differ: all that lie beside `changed`, and maybe
/// others.
Pixels apartBeside(PictureShares& shares, const Pixels& changed) {
  constexpr std::size_t kFew = 64; // looking all around one pixel takes as long as passing over so many
  if (changed.size() > shares.grid.pixels() / kFew) return pixelsApart(shares.grid, shares.shares, kEdge);
  return pixelsBeside(shares, changed,
                      [&](std::uint32_t pixel, std::uint32_t /*beside*/) { return shares.isApart(pixel, kEdge); });
}

} // namespace

void tracePenumbras(const PicturePoints& points, const TracedLight& light, int samples, PictureShares& shares) {
  const std::vector<Round> rounds = roundsUpTo(static_cast<std::uint32_t>(std::max(samples, 1)));
  if (rounds.empty()) return;
  const auto isIn = [&](std::size_t round, std::uint32_t pixel) {
    const std::uint8_t mark = shares.marks[pixel];
    return mark / PictureShares::kRound == static_cast<int>(round) && (mark & PictureShares::kAway) == 0 &&
           points.numberAt(shares.grid.pixelAt(pixel)) != kNoNumber;
  };
  const auto isAsked = [&](std::uint32_t pixel, std::uint32_t /*beside*/) { return isIn(0, pixel); };
  Pixels next = pixelsWhere(shares.grid, firstDoubts(points, shares),
                            [](std::uint8_t /*least*/, std::uint8_t most) { return most != 0; });
  std::erase_if(next, [&](std::uint32_t pixel) { return !isIn(0, pixel); });
  while (!next.empty()) {
    trace(points, light, rounds[0], next, shares);
    // More rays may have found what a single one missed, and at the rim of a penumbra they may miss it, too.
    next = pixelsBeside(
        shares, next, [&](std::uint32_t pixel, std::uint32_t traced) { return shares.apart(pixel, traced) >= kEdge; });
    next = pixelsBeside(shares, next, isAsked);
  }
  Pixels doubtful;
  if (rounds.size() > 1) doubtful = pixelsApart(shares.grid, shares.shares, kEdge);
  while (!doubtful.empty()) {
    Pixels traced;
    for (std::size_t round = rounds.size() - 1; round > 0; --round) {
      Pixels behind;
      std::copy_if(doubtful.begin(), doubtful.end(), std::back_inserter(behind),
                   [&](std::uint32_t pixel) { return isIn(round, pixel); });
      trace(points, light, rounds[round], behind, shares);
      traced.insert(traced.end(), behind.begin(), behind.end());
    }
    // What agreed with a pixel that had four rays may not do so any more.
    doubtful = apartBeside(shares, traced);
  }
  std::vector<int> raysOf;
  for (const Round& round : rounds) raysOf.push_back(static_cast<int>(round.last));
  evenOut(points, raysOf, shares);
}

} // namespace gnomon
