#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon {

/// Which two texels of a side one of the next smaller level lies between, and the second one's share.
struct BetweenTexels {
  std::size_t first = 0, second = 0;
  double share = 0;
};

/// For each of `to` texels that a side of `from` becomes. REQUIRES: 1 <= to <= from.
inline std::vector<BetweenTexels> betweenTexels(int from, int to) {
  std::vector<BetweenTexels> all(static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) * from / to - 0.5;
    const auto first = static_cast<std::size_t>(std::floor(place));
    all[i] = {first, std::min(first + 1, static_cast<std::size_t>(from) - 1), place - std::floor(place)};
  }
  return all;
}

} // namespace gnomon
