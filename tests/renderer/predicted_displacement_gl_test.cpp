// How far edges are expected to be off, held against how far they are.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocol/evaluation_json.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

struct NamedScene {
  std::string name;
  ScenePtr scene;
};

SceneBundle bundleOf(const fs::path& assets, const nlohmann::json& model) {
  const fs::path path = assets / model.at("path").get<std::string>();
  SceneBundle bundle{testing::readFile(path), {}};
  for (const auto& file : model.at("files")) {
    const fs::path other = assets / file.get<std::string>();
    if (other == path) continue;
    bundle.files[other.lexically_relative(path.parent_path()).generic_string()] = testing::readFile(other);
  }
  return bundle;
}

std::vector<NamedScene> gathered() {
  const fs::path assets = GNOMON_TEST_ASSETS;
  std::vector<NamedScene> scenes;
  if (!fs::exists(assets / "manifest.json")) return scenes;
  const auto manifest = nlohmann::json::parse(std::ifstream(assets / "manifest.json"));
  for (const auto& model : manifest.at("models")) {
    if (auto scene = loadScene(bundleOf(assets, model))) scenes.push_back({model.at("id"), std::move(*scene)});
  }
  return scenes;
}

std::vector<NamedScene> own() {
  std::vector<NamedScene> scenes;
  for (const auto& entry : fs::directory_iterator(GNOMON_TEST_SCENES)) {
    if (entry.path().extension() == ".glb") scenes.push_back({entry.path().stem(), testing::generatedScene(entry.path().stem())});
  }
  return scenes;
}

Result<EvaluationReport> evaluated(const ScenePtr& scene, const char* spec) {
  auto evaluation = decodeEvaluation(std::string(R"({"repeats": 1, "spec": )") + spec + R"(, "variants": [
      {"shadow": {"filter": {"type": "hard"}}}, {"shadow": {"filter": {"type": "pcf", "size": 5}}}]})");
  EXPECT_TRUE(evaluation);
  Renderer& renderer = testing::sharedRenderer();
  const EvaluationTools tools{
      [&](const FrameSpec& variant) { return renderer.render(scene, variant, TileUse::drawnAnew); }, {}};
  return evaluate(scene, *evaluation, renderer.info(), tools);
}

double ratiosOver(const std::vector<NamedScene>& scenes, const char* spec) {
  std::vector<double> ratios;
  for (const NamedScene& each : scenes) {
    const auto report = evaluated(each.scene, spec);
    if (!report) continue;
    for (const auto& row : report->rows) {
    if (!row.metrics || !row.metrics->edgeDisplacement || !row.metrics->predicted->edgeDisplacement) continue;
    const double measured = row.metrics->edgeDisplacement->mean;
    const double predicted = *row.metrics->predicted->edgeDisplacement;
    std::printf("%-44s %-6.6s %7.3f %7.3f %6.2f  len %7.0f  %.2f mis %.4f int %.4f\n", each.name.c_str(), row.name.c_str()+0, measured, predicted, predicted / measured, *row.metrics->predicted->edgeLength, row.metrics->predicted->median, row.metrics->misclassified,row.metrics->interior);
    ratios.push_back(predicted / measured);
    }
  }
  if (ratios.empty()) return 1;
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

constexpr const char* kView = R"({"width": 640, "height": 360, "antialiasing": "none", "camera": {"fit": true},
    "lights": [{"type": "directional", "sun": {"azimuthDegrees": 135, "elevationDegrees": 40}}]})";

TEST(PredictedDisplacement, H2_GatheredScenes) {
  const auto scenes = gathered();
  if (scenes.empty()) GTEST_SKIP();
  EXPECT_NEAR(ratiosOver(scenes, kView), 1, 0.25);
}

TEST(PredictedDisplacement, H2_OwnScenes) { EXPECT_NEAR(ratiosOver(own(), kView), 1, 0.25); }

} // namespace
} // namespace gnomon
