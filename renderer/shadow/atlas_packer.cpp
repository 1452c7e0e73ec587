#include "renderer/shadow/atlas_packer.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "renderer/shadow/tile_size.h"

namespace gnomon {
namespace {

std::int64_t areaOf(std::span<const TileRequest> requests, const std::vector<int>& sizes) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    area += static_cast<std::int64_t>(requests[i].tileCount) * sizes[i] * sizes[i];
  }
  return area;
}

/// The request to halve next, or the number of requests where none may shrink further.
std::size_t nextToHalve(std::span<const TileRequest> requests, const std::vector<int>& sizes) {
  std::size_t best = requests.size();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (sizes[i] <= kSmallestTile || requests[i].tileCount == 0) continue;
    const auto yields = [&](std::size_t r) {
      return std::tuple(-static_cast<int>(requests[r].importance), sizes[r], requests[r].light);
    };
    if (best == requests.size() || yields(i) > yields(best)) best = i;
  }
  return best;
}

/// What is left goes back to those that were halved, the most important and the lowest light first.
std::vector<int> grown(std::span<const TileRequest> requests, std::vector<int> sizes, int atlasSide) {
  const std::int64_t room = static_cast<std::int64_t>(atlasSide) * atlasSide;
  std::vector<std::size_t> order(requests.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(-static_cast<int>(requests[a].importance), requests[a].light) <
           std::tuple(-static_cast<int>(requests[b].importance), requests[b].light);
  });
  for (const std::size_t i : order) {
    while (sizes[i] > 0 && 2 * sizes[i] <= std::min(requests[i].size, atlasSide)) {
      sizes[i] *= 2;
      if (areaOf(requests, sizes) <= room) continue;
      sizes[i] /= 2;
      break;
    }
  }
  return sizes;
}

/// Every second bit, from the lowest, as one number.
int evenBits(std::uint64_t bits) {
  int result = 0;
  for (int i = 0; i < 31; ++i) result |= static_cast<int>((bits >> (2 * i)) & 1u) << i;
  return result;
}

} // namespace

std::vector<int> grantTileSizes(std::span<const TileRequest> requests, int atlasSide) {
  const std::int64_t room = static_cast<std::int64_t>(atlasSide) * atlasSide;
  std::vector<bool> refused(requests.size(), atlasSide < kSmallestTile);
  for (;;) {
    std::vector<int> sizes(requests.size(), 0);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (!refused[i]) sizes[i] = std::min(requests[i].size, atlasSide);
    }
    while (areaOf(requests, sizes) > room) {
      const std::size_t halved = nextToHalve(requests, sizes);
      if (halved == requests.size()) break;
      sizes[halved] /= 2;
    }
    if (areaOf(requests, sizes) <= room) return grown(requests, std::move(sizes), atlasSide);

    std::size_t last = requests.size();
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (refused[i]) continue;
      const auto yields = [&](std::size_t r) {
        return std::pair(-static_cast<int>(requests[r].importance), requests[r].light);
      };
      if (last == requests.size() || yields(i) > yields(last)) last = i;
    }
    refused[last] = true;
  }
}

AtlasLayout packSquares(std::span<const TileSquare> squares) {
  AtlasLayout layout;
  layout.rects.resize(squares.size());
  if (squares.empty()) return layout;

  std::vector<std::size_t> order(squares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(-squares[a].size, squares[a].light, squares[a].cascade) <
           std::tuple(-squares[b].size, squares[b].light, squares[b].cascade);
  });

  std::uint64_t taken = 0; // texels along the curve; a multiple of the next square's area, as sizes only fall
  for (const std::size_t i : order) {
    const int size = squares[i].size;
    layout.rects[i] = {evenBits(taken), evenBits(taken >> 1), size, size};
    taken += static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size);
  }
  const int bits = std::countr_zero(std::bit_ceil(taken));
  layout.width = 1 << ((bits + 1) / 2);
  layout.height = 1 << (bits / 2);
  return layout;
}

} // namespace gnomon
