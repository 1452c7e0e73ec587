#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "protocol/cost/frame_cost.h"
#include "protocol/spec/frame_lights.h"

namespace gnomon {
namespace {

FrameSpec specWith(const Light& light) {
  FrameSpec spec;
  spec.lights = {light};
  return spec;
}

TechniqueChoice chosenFor(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device = DeviceKind::processor) {
  return chooseTechnique(lightsOf(spec, {}).front(), spec, scene, device);
}

constexpr SceneCounts kModel{.triangles = 5000};

TEST(ChosenTechnique, IsRaysForASunOverAModelAndMapsWhereRaysMeetHoles) {
  const TechniqueChoice rays = chosenFor(FrameSpec{}, kModel);
  EXPECT_EQ(rays.technique, ShadowTechnique::rayTraced);
  EXPECT_LE(rays.rayMilliseconds, kRaysPerMap * rays.mapMilliseconds);
  const TechniqueChoice map = chosenFor(FrameSpec{}, {.triangles = 5000, .holed = 5000});
  EXPECT_EQ(map.technique, ShadowTechnique::shadowMap);
  EXPECT_GT(map.rayMilliseconds, kRaysPerMap * map.mapMilliseconds);
  EXPECT_NE(rays.why, map.why);
}

TEST(ChosenTechnique, IsAMapOnAGpuAndRaysWithOpenGlInSoftware) {
  EXPECT_EQ(chosenFor(FrameSpec{}, kModel, DeviceKind::gpu).technique, ShadowTechnique::shadowMap);
  EXPECT_EQ(chosenFor(FrameSpec{}, {.triangles = 5000, .holed = 50}, DeviceKind::softwareGl).technique,
            ShadowTechnique::rayTraced);
}

TEST(ChosenTechnique, IsAMapWhereTheRequestSetsWhatOnlyMapsHave) {
  FrameSpec filtered;
  filtered.shadow.filter.type = FilterType::msm;
  EXPECT_EQ(chosenFor(filtered, kModel).technique, ShadowTechnique::shadowMap);
  FrameSpec biased;
  biased.shadow.bias.mode = BiasMode::manual;
  EXPECT_EQ(chosenFor(biased, kModel).technique, ShadowTechnique::shadowMap);
}

/// A row of measured_shadows.csv.
struct Measured {
  std::string scene, light;
  int width = 0, height = 0, samples = 0;
  SceneCounts counts;
  double off = 0, map = 0, rays = 0;

  double ratio() const { return std::max(rays - off, 0.3) / std::max(map - off, 0.3); }
};

std::vector<Measured> measuredShadows() {
  std::ifstream file(GNOMON_MEASURED_SHADOWS);
  std::vector<Measured> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.starts_with("scene,")) continue;
    std::replace(line.begin(), line.end(), ' ', '_');
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Measured row;
    fields >> row.scene >> row.light >> row.width >> row.height >> row.samples >> row.counts.triangles >>
        row.counts.holed >> row.off >> row.map >> row.rays;
    EXPECT_TRUE(fields) << line;
    rows.push_back(row);
  }
  return rows;
}

FrameSpec specOf(const Measured& row) {
  Light light;
  light.type = row.light.ends_with("sun")    ? LightType::directional
               : row.light.ends_with("spot") ? LightType::spot
                                             : LightType::point;
  light.outerConeDegrees = 50;
  const bool soft = row.light.starts_with("soft");
  if (soft && light.type == LightType::directional) light.angularDiameterDegrees = 0.53;
  if (soft && light.type != LightType::directional) light.radius = 1;
  FrameSpec spec = specWith(light);
  spec.width = row.width;
  spec.height = row.height;
  spec.antialiasing = row.samples > 1 ? Antialiasing::msaa4x : Antialiasing::none;
  return spec;
}

std::vector<double> ranksOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<double>(i);
  return ranks;
}

/// Spearman's, 1 = the same order.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ranksA = ranksOf(a), ranksB = ranksOf(b);
  const auto n = static_cast<double>(a.size());
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (ranksA[i] - ranksB[i]) * (ranksA[i] - ranksB[i]);
  return 1 - 6 * squares / (n * (n * n - 1));
}

TEST(ChosenTechnique, FollowsMeasuredTimes) {
  const std::vector<Measured> rows = measuredShadows();
  ASSERT_GT(rows.size(), 500u);
  std::vector<double> measured, estimated;
  int wrong = 0;
  for (const Measured& row : rows) {
    const TechniqueChoice choice = chosenFor(specOf(row), row.counts);
    measured.push_back(row.ratio());
    estimated.push_back(choice.rayMilliseconds / choice.mapMilliseconds);
    const bool rays = choice.technique == ShadowTechnique::rayTraced;
    // By more than a quarter.
    wrong += row.ratio() > 1.25 * kRaysPerMap && rays ? 1 : 0;
    wrong += row.ratio() < kRaysPerMap / 1.25 && !rays ? 1 : 0;
  }
  EXPECT_GE(rankCorrelation(measured, estimated), 0.75);
  EXPECT_LE(wrong, static_cast<int>(rows.size()) / 10);
  RecordProperty("wrong", wrong);
}

} // namespace
} // namespace gnomon
