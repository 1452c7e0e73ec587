#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/core/rect.h"
#include "renderer/core/vectors.h"
#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// Blocks of the picture, in which a packet of rays takes squares of 4 x 4 pixels: rays of a packet stay together, and
/// what one core has in hand of them stays in its caches.
inline constexpr int kBlockWidth = 32;
inline constexpr int kBlockHeight = 16;

/// Shares of 255 that differ by less show no edge between them, and are as sure as rays have to make them.
inline constexpr std::uint8_t kEdge = 26;

using Pixels = std::vector<std::uint32_t>;

inline int blockColumns(const SampleGrid& grid) {
  return (grid.width + kBlockWidth - 1) / kBlockWidth;
}

/// Block number `number`, row by row from the lowest. It may reach over the picture's right and upper side.
inline Rect blockOf(const SampleGrid& grid, std::uint32_t number) {
  const int columns = blockColumns(grid);
  const int at = static_cast<int>(number);
  return {at % columns * kBlockWidth, at / columns * kBlockHeight, kBlockWidth, kBlockHeight};
}

/// Calls `each(block)` for all blocks of the picture, in parallel.
inline void forEachBlock(const SampleGrid& grid, const std::function<void(const Rect&)>& each) {
  const int rows = (grid.height + kBlockHeight - 1) / kBlockHeight;
  const std::size_t count = static_cast<std::size_t>(blockColumns(grid)) * static_cast<std::size_t>(rows);
  forEach(count, [&](std::size_t i) { each(blockOf(grid, static_cast<std::uint32_t>(i))); });
}

/// Calls `each(pixel)` for the pixels of a block of the picture, square by square.
template <class Each>
void forEachPixel(const SampleGrid& grid, const Rect& block, Each each) {
  constexpr int kSquare = 4;
  const int right = std::min(block.x + block.width, grid.width);
  const int top = std::min(block.y + block.height, grid.height);
  for (int y = block.y; y < top; y += kSquare) {
    for (int x = block.x; x < right; x += kSquare) {
      for (int row = y; row < std::min(y + kSquare, top); ++row) {
        for (int column = x; column < std::min(x + kSquare, right); ++column) each(glm::ivec2(column, row));
      }
    }
  }
}

/// Calls `each(number)` for a pixel and for those next to it or to its corners.
template <class Each>
void forEachAround(const SampleGrid& grid, std::uint32_t pixel, Each each) {
  const glm::ivec2 at = grid.pixelAt(pixel);
  for (int row = std::max(at.y - 1, 0); row <= std::min(at.y + 1, grid.height - 1); ++row) {
    for (int column = std::max(at.x - 1, 0); column <= std::min(at.x + 1, grid.width - 1); ++column) {
      each(grid.numberOf({column, row}));
    }
  }
}

/// What is known so far of one light's shadow over a picture.
struct PictureShares {
  explicit PictureShares(const SampleGrid& picture)
      : grid(picture),
        places(picture.samples()),
        values(places * picture.pixels() + places * picture.pixels() % 2),
        shares(picture.pixels()),
        marks(picture.pixels()),
        taken(picture.pixels()) {}

  static constexpr std::uint8_t kAway = 1;  ///< what was drawn there is turned away from the light
  static constexpr std::uint8_t kExact = 2; ///< rays were sent from each of its samples
  static constexpr std::uint8_t kAsked = 4; ///< more rays are about to be sent from there
  static constexpr std::uint8_t kRound = 8; ///< a round of rays was; as often as there were rounds

  const SampleGrid& grid;
  std::size_t places;                   ///< samples of a pixel
  UnfilledVector<std::uint16_t> values; ///< as TracedShadow::values, and one more where they are odd: read by pairs
  UnfilledVector<std::uint8_t> shares;  ///< 0..255, one a pixel: the mean of its samples
  UnfilledVector<std::uint8_t> marks;   ///< one a pixel
  std::vector<std::uint8_t> taken;      ///< one a pixel: 0 but while pixelsBeside looks for them

  std::uint16_t* valuesOf(std::uint32_t pixel) { return values.data() + pixel * places; }
  const std::uint16_t* valuesOf(std::uint32_t pixel) const { return values.data() + pixel * places; }
  int apart(std::uint32_t a, std::uint32_t b) const {
    return std::abs(static_cast<int>(shares[a]) - static_cast<int>(shares[b]));
  }

  /// Whether a pixel, or one beside or at a corner of it, differs by `least` or more from another of these.
  bool isApart(std::uint32_t pixel, int least) const {
    std::uint8_t low = 255;
    std::uint8_t high = 0;
    forEachAround(grid, pixel, [&](std::uint32_t other) {
      low = std::min(low, shares[other]);
      high = std::max(high, shares[other]);
    });
    return high - low >= least;
  }

  /// Of a pixel whose samples are all represented by one of them.
  void set(std::uint32_t pixel, float share) {
    std::uint16_t* own = valuesOf(pixel);
    *own = unorm16(share);
    for (std::size_t i = 1; i < places; ++i) own[i] = *own;
    shares[pixel] = unorm8(share);
  }
};

/// The pixels of both, each once.
inline Pixels either(PictureShares& shares, Pixels some, const Pixels& others) {
  for (const std::uint32_t pixel : some) shares.taken[pixel] = 1;
  std::copy_if(others.begin(), others.end(), std::back_inserter(some),
               [&](std::uint32_t pixel) { return shares.taken[pixel] == 0; });
  for (const std::uint32_t pixel : some) shares.taken[pixel] = 0;
  return some;
}

/// The pixels next to one of `pixels`, or to a corner, for which `keep(pixel, other)` holds of one of those; each once.
/// Asks `keep` on all cores.
template <class Keep>
Pixels pixelsBeside(PictureShares& shares, const Pixels& pixels, Keep keep) {
  constexpr std::size_t kPiece = 1024;
  constexpr std::size_t kPieces = 64; ///< of which is kept at a time what was found, up to nine times each
  Pixels beside;
  for (std::size_t begin = 0; begin < pixels.size(); begin += kPieces * kPiece) {
    const auto some = std::span(pixels).subspan(begin, std::min(kPieces * kPiece, pixels.size() - begin));
    std::vector<Pixels> found(kPieces);
    forEachPiece(some.size(), kPiece, [&](std::size_t first, std::size_t last) {
      for (const std::uint32_t pixel : some.subspan(first, last - first)) {
        forEachAround(shares.grid, pixel, [&](std::uint32_t other) {
          if (keep(other, pixel)) found[first / kPiece].push_back(other);
        });
      }
    });
    for (const Pixels& piece : found) {
      std::copy_if(piece.begin(), piece.end(), std::back_inserter(beside),
                   [&](std::uint32_t pixel) { return std::exchange(shares.taken[pixel], std::uint8_t{1}) == 0; });
    }
  }
  for (const std::uint32_t pixel : beside) shares.taken[pixel] = 0;
  return beside;
}

// Send rays from every sample of some pixels, and give the pixels whose shares changed.

/// From where camera rays lead, to a light that has no size. Bit by bit what a reference finds there.
Pixels traceExactly(const PicturePoints& points, const TracedLight& light, const Pixels& pixels, PictureShares& shares);

/// To a light that has a size, whose shares are estimates: from where camera rays lead only if that is another triangle
/// than was drawn. `rays`: of a sample. REQUIRES: tracePenumbras.
Pixels traceDoubtful(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                     PictureShares& shares);

/// The same from the points as they were drawn, without camera rays. The samples of a pixel go to other places of the
/// light.
Pixels traceSamples(const PicturePoints& points, const TracedLight& light, int rays, const Pixels& pixels,
                    PictureShares& shares);

/// Sends more rays to a light that has a size from where the first one a pixel, which `shares` holds, leaves a doubt:
/// to 4 from every pixel that lies within two of where shares differ, until there is none any more, and from those
/// beside masks, where what shows may be a pixel large; then to four times as many, and so on up to `samples`, from
/// those that differ by as much as an edge or noise would. At last evens out what noise is left. The places on the
/// light that the first rays of 4 x 4 pixels go to fill it evenly, so that a penumbra is missed only where it takes a
/// few hundredths of the light at most.
void tracePenumbras(const PicturePoints& points, const TracedLight& light, int samples, PictureShares& shares);

/// Few rays leave noise in a penumbra, which is another from pixel to pixel, while a wide penumbra is nearly the same:
/// brings each pixel that more rays than the first were sent from as close to the slope of those around it as noise has
/// to do with their differences (share_square.h). `raysOf`: how many rays a pixel has had after each round.
void evenOut(const PicturePoints& points, std::span<const int> raysOf, PictureShares& shares);

} // namespace gnomon
