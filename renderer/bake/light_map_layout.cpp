#include "renderer/bake/light_map_layout.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/bake/pack_rectangles.h"
#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"

namespace gnomon {
namespace {

constexpr int kGutter = 1; ///< texels around a chart

struct InstanceCharts {
  std::vector<SurfaceChart> charts;
  bool authored = false;
};

std::vector<InstanceCharts> chartsOfAll(const Scene& scene, const SceneView& view) {
  std::vector<InstanceCharts> all(view.instances.size());
  forEach(all.size(), [&](std::size_t i) {
    const Instance& instance = view.instances[i];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    if (auto authored = authoredChartsOf(scene, primitive, instance.worldFromLocal)) {
      all[i] = {*std::move(authored), true};
    } else {
      all[i] = {chartsOf(scene, primitive, instance.worldFromLocal), false};
    }
  });
  return all;
}

std::vector<glm::dvec2> sizesOf(const std::vector<InstanceCharts>& all) {
  std::vector<glm::dvec2> sizes;
  for (const InstanceCharts& instance : all) {
    for (const SurfaceChart& chart : instance.charts) sizes.push_back(chart.size);
  }
  return sizes;
}

/// A chart's rectangle at so many texels a metre. Far larger than any map where it would be.
glm::ivec2 texelsOf(const glm::dvec2& size, double density) {
  const glm::dvec2 texels = glm::clamp(glm::ceil(size * density), 1.0, 4.0 * kLimits.maxLightMapSide);
  return glm::ivec2(texels) + 2 * kGutter;
}

struct Packed {
  int width = 0;
  RectanglePacking packing;

  int longest() const { return std::max(width, packing.height); }
};

/// About square; nothing where that is larger than kLimits.maxLightMapSide.
std::optional<Packed> packed(const std::vector<glm::dvec2>& sizes, double density) {
  std::vector<glm::ivec2> texels;
  double area = 0;
  int widest = 1;
  for (const glm::dvec2& size : sizes) {
    texels.push_back(texelsOf(size, density));
    area += static_cast<double>(texels.back().x) * texels.back().y;
    widest = std::max({widest, texels.back().x, texels.back().y});
  }
  if (widest > kLimits.maxLightMapSide || area > double{kLimits.maxLightMapSide} * kLimits.maxLightMapSide)
    return std::nullopt;
  // What charts leave free between them is seldom more than a tenth.
  const int side = (std::max(widest, static_cast<int>(std::sqrt(1.1 * area))) + 3) / 4 * 4;
  Packed result{std::min(side, kLimits.maxLightMapSide),
                packRectangles(texels, std::min(side, kLimits.maxLightMapSide))};
  if (result.packing.height > kLimits.maxLightMapSide) return std::nullopt;
  return result;
}

bool fits(const std::vector<glm::dvec2>& sizes, double density, int size) {
  const auto result = packed(sizes, density);
  return result && result->longest() <= size;
}

/// More than a map of that size has room for.
double densityBeyond(const std::vector<glm::dvec2>& sizes, int size) {
  double area = 0;
  for (const glm::dvec2& each : sizes) area += each.x * each.y;
  return 2 * size / std::sqrt(std::max(area, 1e-300));
}

constexpr int kHalvings = 14; ///< of that density, in search of the finest

/// The finest density at which the map is no longer than `size`; 0 where none is.
double densityFor(const std::vector<glm::dvec2>& sizes, int size) {
  double high = densityBeyond(sizes, size);
  double low = 0;
  if (!fits(sizes, 0, size)) return 0;
  for (int step = 0; step < kHalvings; ++step) {
    stopIfAsked();
    const double middle = 0.5 * (low + high);
    (fits(sizes, middle, size) ? low : high) = middle;
  }
  return low;
}

/// The least size that the charts fit into, at the coarsest density that densityFor() tries; nothing where they fit
/// into none.
std::optional<int> leastSize(const std::vector<glm::dvec2>& sizes) {
  const auto hasRoom = [&](int size) {
    stopIfAsked();
    return fits(sizes, std::ldexp(densityBeyond(sizes, size), -kHalvings), size);
  };
  const auto coarsest = packed(sizes, 0);
  if (!coarsest) return std::nullopt;
  int low = coarsest->longest() - 1; // does not fit
  int high = low + 1;
  for (int step = 1; !hasRoom(high); step *= 2) {
    if (high == kLimits.maxLightMapSide) return std::nullopt;
    low = high;
    high = std::min(high + step, kLimits.maxLightMapSide);
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (hasRoom(middle) ? high : low) = middle;
  }
  return high;
}

Problem tooLarge(const LightMapFineness& fineness, const std::vector<glm::dvec2>& sizes) {
  if (fineness.size) {
    const auto least = leastSize(sizes);
    return {ProblemCode::invalidValue, "/size",
            "The scene's surfaces fall into " + std::to_string(sizes.size()) + " charts, which do not fit into " +
                (least ? "the light map." : "a light map of any size."),
            least ? std::to_string(*least) + ".." + std::to_string(kLimits.maxLightMapSide) : "",
            std::to_string(*fineness.size)};
  }
  return {ProblemCode::invalidValue, "/texelsPerMetre",
          "At this fineness the light map of the scene has sides of more than " +
              std::to_string(kLimits.maxLightMapSide) + " texels.",
          "", std::to_string(*fineness.texelsPerMetre)};
}

LightMapLayout placed(const Scene& scene, const SceneView& view, std::vector<InstanceCharts> all, const Packed& packed,
                      double density) {
  LightMapLayout layout;
  layout.width = packed.width;
  layout.height = packed.packing.height;
  layout.texelsPerMetre = density;
  auto rect = packed.packing.rects.begin();
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(view.instances[i].primitive)];
    layout.firstCorner.push_back(layout.corners.size());
    layout.corners.resize(layout.corners.size() + primitive.indexCount);
    layout.authored.push_back(all[i].authored ? 1 : 0);
    for (SurfaceChart& chart : all[i].charts) {
      const glm::dvec2 origin(rect->x + kGutter, rect->y + kGutter);
      for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
        glm::vec2* corners = &layout.corners[layout.firstCorner[i] + 3 * std::size_t{chart.triangles[t]}];
        for (std::size_t k = 0; k < 3; ++k) corners[k] = glm::vec2(origin + chart.flat[t][k] * density);
      }
      layout.charts.push_back({i, std::move(chart.triangles), *rect++});
    }
  }
  return layout;
}

} // namespace

Result<LightMapLayout> lightMapLayout(const Scene& scene, const SceneView& view, const LightMapFineness& fineness) {
  std::vector<InstanceCharts> all = chartsOfAll(scene, view);
  const std::vector<glm::dvec2> sizes = sizesOf(all);
  if (sizes.empty()) return LightMapLayout{};
  const double density = fineness.size ? densityFor(sizes, *fineness.size) : fineness.texelsPerMetre.value_or(0);
  if (!(density > 0)) return tooLarge(fineness, sizes);
  const auto fitted = packed(sizes, density);
  if (!fitted) return tooLarge(fineness, sizes);
  return placed(scene, view, std::move(all), *fitted, density);
}

} // namespace gnomon
