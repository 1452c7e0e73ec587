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
  const SampleGrid& grid;
  std::vector<std::uint8_t> lit;    ///< one a pixel: 1 = the light arrives
  std::vector<std::uint8_t> traced; ///< 1 = a ray decides

  /// True where a neighbour, or one at a corner, is decided otherwise.
  bool atEdge(int x, int row) const {
    const auto at = [&](int column, int line) {
      return lit[static_cast<std::size_t>(line) * static_cast<std::size_t>(grid.width) +
                 static_cast<std::size_t>(column)];
    };
    for (int line = std::max(row - 1, 0); line <= std::min(row + 1, grid.height - 1); ++line) {
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, grid.width - 1); ++column) {
        if (at(column, line) != at(x, row)) return true;
      }
    }
    return false;
  }
};

/// Pixels that the map is sure of, next to another decision: where the rim of a surface passes, rounding may show
/// either side of it.
std::vector<std::uint32_t> sureAtEdges(const Decisions& decisions) {
  std::vector<std::uint32_t> found;
  std::uint32_t pixel = 0;
  for (int row = 0; row < decisions.grid.height; ++row) {
    for (int x = 0; x < decisions.grid.width; ++x, ++pixel) {
      if (decisions.traced[pixel] == 0 && decisions.atEdge(x, row)) found.push_back(pixel);
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
  Decisions decisions{grid, std::vector<std::uint8_t>(grid.pixels()), std::vector<std::uint8_t>(grid.pixels())};
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
    toTrace = sureAtEdges(decisions);
  }
  return shadow;
}

} // namespace gnomon
