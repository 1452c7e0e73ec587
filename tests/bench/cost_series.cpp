#include "tests/bench/cost_series.h"

#include <cstdio>
#include <stdexcept>

#include "protocol/spec/enum_rows.h"
#include "tests/bench/bodies_scene.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

using nlohmann::json;

json merged(json spec, const json& patch) {
  spec.merge_patch(patch);
  return spec;
}

ScenePtr city() {
  static const ScenePtr scene = [] {
    auto loaded = loadScene({testing::readFile(GNOMON_TEST_SCENES "/city.glb"), {}});
    if (!loaded) throw std::runtime_error(loaded.problems().front().detail);
    return *loaded;
  }();
  return scene;
}

json sun() {
  return {{"type", "directional"}, {"sun", {{"azimuthDegrees", 150}, {"elevationDegrees", 35}}}};
}

CostPoint inTheCity(const std::string& label, double x, const json& spec, const json& patch) {
  const json mapped = {{"lights", {sun()}}, {"shadow", {{"technique", "shadowMap"}}}};
  return {label, x, merged(merged(spec, mapped), patch), city};
}

CostSeries againstCascades(const json& spec) {
  CostSeries series{"cascades", "Cost against the number of cascades", "cascades of 1024 x 1024 texels", true, {}};
  for (int count = 1; count <= 8; ++count) {
    series.points.push_back(inTheCity(std::to_string(count), count, spec, {{"shadow", {{"cascadeCount", count}}}}));
  }
  return series;
}

CostSeries againstSpots(const json& spec) {
  CostSeries series{"spots", "Cost against the number of shadowed spots", "spots", true, {}};
  for (const int count : {1, 4, 16, 64}) {
    series.points.push_back(inTheCity(std::to_string(count), count, spec, {{"lights", cityLamps(count)}}));
  }
  return series;
}

CostSeries againstTiles(const json& spec) {
  CostSeries series{"tiles", "Cost against the size of the tiles", "atlas.baseSize, texels, 4 cascades", true, {}};
  for (const int size : {256, 512, 1024, 2048}) {
    series.points.push_back(inTheCity(std::to_string(size), size, spec, {{"atlas", {{"baseSize", size}}}}));
  }
  return series;
}

CostSeries againstFilters(const json& spec) {
  CostSeries series{"filters", "Cost against the filter", "shadow.filter, 4 cascades", false, {}};
  const auto add = [&](const std::string& label, const json& filter) {
    series.points.push_back(inTheCity(label, 0, spec, {{"shadow", {{"filter", filter}}}}));
  };
  for (const Spelling& type : kSpellings<FilterType>) {
    const std::string name(type.name);
    if (type.value == static_cast<int>(FilterType::pcf)) {
      for (const int size : {3, 5, 7}) add(name + " " + std::to_string(size), {{"type", name}, {"size", size}});
      add(name + " 10 cm", {{"type", name}, {"radius", 0.1}});
    } else {
      add(name, {{"type", name}});
    }
  }
  return series;
}

CostSeries againstTriangles(const json& spec) {
  CostSeries series{
      "triangles", "Cost against the number of triangles", "triangles in the scene, 4 cascades", true, {}};
  for (const int side : {2, 4, 8, 16, 24, 40}) {
    const double count = side * side * 2600.0 + 2;
    char label[16];
    std::snprintf(label, sizeof label, count < 1e6 ? "%.0f k" : "%.1f M", count / (count < 1e6 ? 1e3 : 1e6));
    series.points.push_back({label, count, merged(spec, {{"lights", {sun()}}}), [side] { return bodiesScene(side); }});
  }
  return series;
}

} // namespace

json cityLamps(int count) {
  json lights = json::array();
  for (int i = 0; i < count; ++i) {
    const double along = (i + 0.5) / count;
    lights.push_back({{"type", "spot"},
                      {"position", {i % 2 == 0 ? 3.2 : -3.2, 7.0, 92.0 - 150.0 * along}},
                      {"direction", {i % 2 == 0 ? -0.35 : 0.35, -1.0, 0.15}},
                      {"range", 25},
                      {"outerConeDegrees", 50},
                      {"intensity", 300}});
  }
  return lights;
}

std::vector<CostSeries> costSeries(const json& spec) {
  const json all = merged(spec, {{"camera", {{"node", "camera"}}}});
  return {againstCascades(all), againstSpots(all), againstTiles(all), againstFilters(all), againstTriangles(all)};
}

} // namespace gnomon::bench
