#include "renderer/techniques/ray_traced_shadow.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Shares that differ by less show no edge between them.
constexpr float kEdge = 0.1f;

/// The pixels next to which, or to whose corners, another share is seen.
std::vector<std::uint32_t> pixelsAtEdges(const SampleGrid& grid, std::span<const float> shares) {
  std::vector<std::uint32_t> found;
  for (int row = 0; row < grid.height; ++row) {
    for (int x = 0; x < grid.width; ++x) {
      const auto at = [&](int column, int line) {
        return shares[static_cast<std::size_t>(line) * static_cast<std::size_t>(grid.width) +
                      static_cast<std::size_t>(column)];
      };
      float least = 1;
      float most = 0;
      for (int line = std::max(row - 1, 0); line <= std::min(row + 1, grid.height - 1); ++line) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, grid.width - 1); ++column) {
          least = std::min(least, at(column, line));
          most = std::max(most, at(column, line));
        }
      }
      if (most - least >= kEdge) found.push_back(static_cast<std::uint32_t>(row * grid.width + x));
    }
  }
  return found;
}

} // namespace

std::vector<std::uint16_t> rayTracedShadow(const TraceInput& input, int light, const SampleGrid& grid,
                                           std::span<const SurfacePoint> hits) {
  const int rays = input.lights[static_cast<std::size_t>(light)].shadow->raySamples;
  const std::vector<float> shares = lightVisibility(input, light, hits, rays);
  const std::size_t samples = grid.samples();
  std::vector<std::uint16_t> values(grid.pixels() * samples);
  for (std::size_t pixel = 0; pixel < shares.size(); ++pixel) {
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(pixel * samples), samples, unorm16(shares[pixel]));
  }
  if (samples == 1) return values;
  const std::vector<std::uint32_t> edges = pixelsAtEdges(grid, shares);
  const std::vector<float> fine = lightVisibility(input, light, firstHits(input, samplesOf(grid, edges)), rays);
  for (std::size_t i = 0; i < fine.size(); ++i) values[edges[i / samples] * samples + i % samples] = unorm16(fine[i]);
  return values;
}

} // namespace gnomon
