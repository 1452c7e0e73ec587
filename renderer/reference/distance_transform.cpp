#include "renderer/reference/distance_transform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "renderer/core/stop.h"

namespace gnomon {

namespace {

constexpr int kNone = std::numeric_limits<int>::max(); ///< pixels: nothing is marked in the column

/// Pixels up or down each column to the nearest mark in it.
std::vector<int> columnDistances(std::span<const std::uint8_t> marks, std::size_t width, std::size_t height) {
  std::vector<int> distances(marks.size(), kNone);
  const auto step = [&](std::size_t at, std::size_t from) {
    if (distances[from] != kNone) distances[at] = std::min(distances[at], distances[from] + 1);
  };
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) {
      distances[i] = 0;
    } else if (i >= width) {
      step(i, i - width);
    }
  }
  for (std::size_t i = width * (height - 1); i-- > 0;) step(i, i + width);
  return distances;
}

/// The columns whose parabolas make up the lower envelope of a row, and where each begins to be the lowest.
struct Envelope {
  std::vector<int> columns;
  std::vector<double> begins;
};

/// Where the parabolas over `left` and `right` cross. Both heights are whole numbers below 2^53, and so the quotient is
/// on the right side of every pixel's centre.
double crossing(const int* row, int left, int right) {
  const auto height = [row](int at) { return static_cast<double>(row[at]) * row[at] + static_cast<double>(at) * at; };
  return (height(right) - height(left)) / (2.0 * (right - left));
}

void fillEnvelope(const int* row, int width, Envelope& envelope) {
  envelope.columns.clear();
  envelope.begins.clear();
  for (int x = 0; x < width; ++x) {
    if (row[x] == kNone) continue;
    double begin = -std::numeric_limits<double>::infinity();
    while (!envelope.columns.empty()) {
      begin = crossing(row, envelope.columns.back(), x);
      if (begin > envelope.begins.back()) break;
      envelope.columns.pop_back();
      envelope.begins.pop_back();
    }
    if (envelope.columns.empty()) begin = -std::numeric_limits<double>::infinity();
    envelope.columns.push_back(x);
    envelope.begins.push_back(begin);
  }
}

} // namespace

// Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012: a parabola over
// each column's distance, and the lower envelope of a row's.
std::vector<float> distancesTo(std::span<const std::uint8_t> marks, int width, int height) {
  assert(marks.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<float> distances(marks.size(), std::numeric_limits<float>::infinity());
  if (marks.empty()) return distances;
  const auto columns = columnDistances(marks, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  Envelope envelope;
  for (std::size_t begin = 0; begin < marks.size(); begin += static_cast<std::size_t>(width)) {
    stopIfAsked();
    const int* row = columns.data() + begin;
    fillEnvelope(row, width, envelope);
    if (envelope.columns.empty()) continue;
    std::size_t lowest = 0;
    for (int x = 0; x < width; ++x) {
      while (lowest + 1 < envelope.columns.size() && envelope.begins[lowest + 1] <= x) ++lowest;
      const int column = envelope.columns[lowest];
      const double across = x - column;
      const double along = row[column];
      distances[begin + static_cast<std::size_t>(x)] = static_cast<float>(std::sqrt(across * across + along * along));
    }
  }
  return distances;
}

} // namespace gnomon
