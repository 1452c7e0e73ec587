#include "protocol/base/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace gnomon {
namespace {

/// Letters to insert, remove or replace, and neighbours to swap (optimal string alignment).
std::size_t editDistance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> beforeLast(to.size() + 1), last(to.size() + 1), row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 0; i < from.size(); ++i) {
    beforeLast.swap(last);
    last.swap(row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = last[j] + (from[i] == to[j] ? 0 : 1);
      row[j + 1] = std::min({replaced, row[j] + 1, last[j + 1] + 1});
      const bool isSwap = i > 0 && j > 0 && from[i] == to[j - 1] && from[i - 1] == to[j];
      if (isSwap) row[j + 1] = std::min(row[j + 1], beforeLast[j - 1] + 1);
    }
  }
  return row.back();
}

} // namespace

std::string nearestName(std::string_view mistyped, std::span<const std::string> names, std::size_t most) {
  constexpr std::size_t kLongest = 256; // whatever is longer resembles no name
  if (mistyped.size() > kLongest) return {};
  std::string_view nearest;
  std::size_t least = std::min(mistyped.size() / 3, most) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = editDistance(mistyped, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return std::string(nearest);
}

std::string suggestion(std::string_view mistyped, std::span<const std::string> names) {
  const std::string nearest = nearestName(mistyped, names);
  return nearest.empty() ? "." : "; did you mean " + nearest + "?";
}

} // namespace gnomon
