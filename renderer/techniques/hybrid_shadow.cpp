#include "renderer/techniques/hybrid_shadow.h"

#include <algorithm>

#include "renderer/passes/views/certainty_pass.h"

namespace gnomon {
namespace {

/// Hybrid shadows are sharp: a size would blur what rays see, and not what the map does.
std::vector<Light> withoutSizes(std::span<const Light> lights) {
  std::vector<Light> sharp(lights.begin(), lights.end());
  for (Light& light : sharp) {
    light.angularDiameterDegrees.reset();
    light.radius.reset();
  }
  return sharp;
}

/// A picture's verdicts, and then what rays make of them.
struct Decisions {
  std::vector<std::uint8_t> lit;    ///< one a pixel: 1 = the light arrives
  std::vector<std::uint8_t> traced; ///< 1 = a ray decides
};

/// Where a row of pixels is decided otherwise than a neighbour, or one at a corner, is: 1 a pixel. `below` and `above`:
/// the rows next to it, or itself. Without a branch, for that is what makes it quick.
void markEdges(const std::uint8_t* below, const std::uint8_t* row, const std::uint8_t* above, std::uint8_t* edges,
               int width) {
  const auto differs = [&](int x, int left, int right) {
    const int others = (below[left] ^ row[x]) | (below[x] ^ row[x]) | (below[right] ^ row[x]) | (row[left] ^ row[x]) |
                       (row[right] ^ row[x]) | (above[left] ^ row[x]) | (above[x] ^ row[x]) | (above[right] ^ row[x]);
    return static_cast<std::uint8_t>(others);
  };
  for (int x = 1; x + 1 < width; ++x) edges[x] = differs(x, x - 1, x + 1);
  edges[0] = differs(0, 0, std::min(1, width - 1));
  edges[width - 1] = differs(width - 1, std::max(width - 2, 0), width - 1);
}

/// Pixels that the map is sure of, next to another decision: where the rim of a surface passes, rounding may show
/// either side of it.
std::vector<std::uint32_t> sureAtEdges(const Decisions& decisions, const SampleGrid& grid) {
  std::vector<std::uint32_t> found;
  std::vector<std::uint8_t> edges(static_cast<std::size_t>(grid.width));
  const auto rowAt = [&](int row) { return decisions.lit.data() + std::ptrdiff_t{row} * grid.width; };
  for (int row = 0; row < grid.height; ++row) {
    markEdges(rowAt(std::max(row - 1, 0)), rowAt(row), rowAt(std::min(row + 1, grid.height - 1)), edges.data(),
              grid.width);
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width);
    for (std::size_t x = 0; x < edges.size(); ++x) {
      if (edges[x] != 0 && decisions.traced[first + x] == 0) found.push_back(static_cast<std::uint32_t>(first + x));
    }
  }
  return found;
}

} // namespace

Result<HybridShadow> hybridShadow(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces,
                                  const TraceInput& rays, int light, const SampleGrid& grid) {
  const auto verdicts = mapVerdicts(inputs, shading, surfaces, light);
  if (!verdicts) return verdicts.problems();
  const std::vector<Light> lights = withoutSizes(rays.lights);
  TraceInput sharp = rays;
  sharp.lights = lights;

  const std::size_t samples = grid.samples();
  HybridShadow shadow;
  shadow.values.resize(grid.pixels() * samples);
  Decisions decisions{std::vector<std::uint8_t>(grid.pixels()), std::vector<std::uint8_t>(grid.pixels())};
  std::vector<std::uint32_t> toTrace;
  for (std::size_t pixel = 0; pixel < verdicts->size(); ++pixel) {
    const Verdict verdict = (*verdicts)[pixel];
    if (verdict == Verdict::unsure) toTrace.push_back(static_cast<std::uint32_t>(pixel));
    decisions.lit[pixel] = verdict == Verdict::lit ? 1 : 0;
    std::fill_n(shadow.values.begin() + static_cast<std::ptrdiff_t>(pixel * samples), samples,
                verdict == Verdict::lit ? std::uint16_t{65535} : std::uint16_t{0});
  }
  while (!toTrace.empty()) {
    const std::vector<float> shares = lightVisibility(sharp, light, firstHits(sharp, samplesOf(grid, toTrace)), 1);
    for (std::size_t i = 0; i < toTrace.size(); ++i) {
      const std::uint32_t pixel = toTrace[i];
      float sum = 0;
      for (std::size_t s = 0; s < samples; ++s) {
        const float share = shares[i * samples + s];
        shadow.values[pixel * samples + s] = unorm16(share);
        sum += share;
      }
      decisions.lit[pixel] = sum >= 0.5f * static_cast<float>(samples) ? 1 : 0;
      decisions.traced[pixel] = 1;
    }
    shadow.tracedPixels += toTrace.size();
    toTrace = sureAtEdges(decisions, grid);
  }
  return shadow;
}

} // namespace gnomon
