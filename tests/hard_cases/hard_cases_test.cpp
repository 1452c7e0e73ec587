// Every NAME.json of this folder is a case: a request at which shadows go wrong, and how wrong each technique may be.
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <map>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/hard_cases/hard_case.h"
#include "tests/hard_cases/hard_table.h"
#include "tests/support/files.h"
#include "tests/support/uncached_renderer.h"

namespace gnomon {
namespace {

using testing::HardCase;
using testing::HardRow;
using testing::Way;

std::vector<HardRow>& rows() {
  static std::vector<HardRow> all;
  return all;
}

/// Prints the table once all cases have run, and leaves it in a file: ctest shows no output of what passes.
class Table : public ::testing::Environment {
 public:
  void TearDown() override {
    const std::string table = testing::tableOf(rows());
    std::cout << '\n' << table;
    const std::string results =
        GNOMON_HARD_RESULTS + std::string(testing::testedDevice() == DeviceChoice::cpu ? "_cpu" : "");
    testing::writeFile(results + ".txt", Bytes(table.begin(), table.end()));
    const std::string numbers = testing::numbersOf(rows()).dump(1);
    testing::writeFile(results + ".json", Bytes(numbers.begin(), numbers.end()));
  }
};
const ::testing::Environment* const kTable = ::testing::AddGlobalTestEnvironment(new Table);

std::string told(const Problems& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.pointer + ": " + problem.detail + "\n";
  return text;
}

Renderer& renderer() {
  static Renderer made = [] {
    auto renderer = testing::uncachedRenderer();
    if (!renderer) throw std::runtime_error(told(renderer.problems()));
    return std::move(*renderer);
  }();
  return made;
}

ScenePtr sceneNamed(const std::string& name) {
  static std::map<std::string, ScenePtr> scenes;
  ScenePtr& scene = scenes[name];
  if (scene == nullptr) {
    auto loaded = loadScene({testing::readFile(std::string(GNOMON_TEST_SCENES "/") + name + ".glb"), {}});
    EXPECT_TRUE(loaded) << told(loaded.problems());
    if (loaded) scene = *loaded;
  }
  return scene;
}

FrameSpec decoded(const Json& request) {
  auto spec = decodeFrameSpec(request.dump());
  EXPECT_TRUE(spec) << told(spec.problems());
  return spec ? *spec : FrameSpec{};
}

struct Picture {
  std::vector<float> pixels; ///< r g b alpha
  double milliseconds = 0;
};

Picture picture(const ScenePtr& scene, Json request, double background) {
  request["background"] = {{"color", {background, background, background}}, {"alpha", 0}};
  const FrameSpec spec = decoded(request);
  const auto begin = std::chrono::steady_clock::now();
  auto frame = renderer().render(scene, spec);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  EXPECT_TRUE(frame) << told(frame.problems());
  if (!frame) return {};
  EXPECT_EQ(frame->images[0].image.channels.size(), 4u);
  return {std::get<std::vector<float>>(std::move(frame->images[0].image.pixels)), took.count()};
}

/// Every pixel was written: a surface, which no background changes, or the background.
void expectWhole(const Picture& dark, const Picture& bright) {
  ASSERT_FALSE(dark.pixels.empty());
  ASSERT_EQ(dark.pixels.size(), bright.pixels.size());
  long faulty = 0;
  for (std::size_t i = 0; i < dark.pixels.size(); i += 4) {
    bool sound = dark.pixels[i + 3] == bright.pixels[i + 3] && (dark.pixels[i + 3] == 0 || dark.pixels[i + 3] == 1);
    for (std::size_t c = i; c < i + 3 && sound; ++c) {
      const bool surface = dark.pixels[i + 3] == 1;
      sound = std::isfinite(dark.pixels[c]) && dark.pixels[c] >= 0 &&
              (surface ? dark.pixels[c] == bright.pixels[c] : dark.pixels[c] == 0 && bright.pixels[c] == 1);
    }
    faulty += sound ? 0 : 1;
  }
  EXPECT_EQ(faulty, 0) << "pixels that hold neither a surface nor the background";
}

/// The metrics by the keys of the bounds: edgeDisplacement is the mean.
Json metricsOf(const FrameReport& report) {
  Json metrics = toJson(report).at("error");
  metrics.erase("predicted");
  if (metrics.contains("edgeDisplacement")) metrics["edgeDisplacement"] = metrics["edgeDisplacement"].at("mean");
  return metrics;
}

double shimmerOf(const ScenePtr& scene, const HardCase& hard, const Json& request) {
  std::vector<Camera> path;
  for (const Json& frame : testing::pathOf(hard, request)) path.push_back(decoded(frame).camera);
  const auto shimmer = renderer().shimmer(scene, decoded(request), path);
  EXPECT_TRUE(shimmer) << told(shimmer.problems());
  return shimmer ? shimmer->perThousand() : HUGE_VAL;
}

/// A metric's bound where `strays` of the receivers may be wrong besides those that it allows.
double widened(const std::string& metric, double bound, double strays) {
  if (metric == "edgeDisplacement") return strays > 0 ? 1.5 * bound : bound;
  return metric == "rms" ? std::sqrt(bound * bound + strays) : bound + strays;
}

/// Every metric is held by a bound, and every bound holds a metric.
void expectWithin(const Json& metrics, const Json& bounds, double strays) {
  for (const auto& [metric, value] : metrics.items()) {
    if (metric == "receivers") continue;
    ASSERT_TRUE(bounds.contains(metric)) << metric << " has no bound; it is " << value;
    EXPECT_LE(value.get<double>(), widened(metric, bounds.at(metric).get<double>(), strays)) << metric;
  }
  for (const auto& [metric, limit] : bounds.items()) {
    // Of few pixels of shadow, one that goes the other way can leave no edge to follow: the bounds are those of OpenGL.
    const bool mayBeMissing = metric == "edgeDisplacement" && testing::testedDevice() == DeviceChoice::cpu;
    EXPECT_TRUE(metrics.contains(metric) || mayBeMissing) << "there is no " << metric << " here";
  }
}

void judge(const ScenePtr& scene, const HardCase& hard, const Way& way) {
  const Json request = testing::requestOf(hard, way, {"color"});
  const Picture dark = picture(scene, request, 0);
  const Picture bright = picture(scene, request, 1);
  expectWhole(dark, bright);

  auto frame = renderer().render(scene, decoded(testing::requestOf(hard, way, {"error"})));
  ASSERT_TRUE(frame) << told(frame.problems());
  Json metrics = metricsOf(frame->report);
  if (hard.file.contains("path")) metrics["shimmer"] = shimmerOf(scene, hard, request);
  rows().push_back({hard.name, way.name, metrics, bright.milliseconds});
  if (hard.file.contains("receivers")) {
    EXPECT_LE(metrics.at("receivers").get<long>(), hard.file["receivers"].get<long>());
    if (!hard.file.at("bounds").contains(way.name)) return;
  }
  ASSERT_TRUE(hard.file.at("bounds").contains(way.name)) << "no bounds for " << way.name;
  // The bounds are llvmpipe's. GPUs snap corners otherwise, by up to a 256th of a pixel, which single pixels show where
  // volumes are as thin as that.
  const bool snapsOtherwise = way.name == "shadowVolume" && !renderer().info().software;
  const double strays = snapsOtherwise ? 16 / metrics.at("receivers").get<double>() : 0;
  expectWithin(metrics, hard.file.at("bounds").at(way.name), strays);
}

void expectRefused(const ScenePtr& scene, const HardCase& hard, const Way& way) {
  const auto frame = renderer().render(scene, decoded(testing::requestOf(hard, way, {"color"})));
  EXPECT_FALSE(frame) << "was drawn";
  if (!frame) rows().push_back({hard.name, way.name, nullptr, 0});
}

class HardCases : public ::testing::TestWithParam<HardCase> {};

TEST_P(HardCases, AreNoWorseThanTheirBounds) {
  const HardCase& hard = GetParam();
  const ScenePtr scene = sceneNamed(hard.file.at("scene").get<std::string>());
  ASSERT_NE(scene, nullptr);
  for (const Way& way : testing::everyWay()) {
    SCOPED_TRACE(way.name);
    const bool volumes = way.name == "shadowVolume" && testing::testedDevice() == DeviceChoice::cpu; // are OpenGL's
    if (volumes || (hard.file.contains("refused") && hard.file["refused"].contains(way.name))) {
      expectRefused(scene, hard, way);
    } else {
      judge(scene, hard, way);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, HardCases, ::testing::ValuesIn(testing::hardCases()),
                         [](const auto& c) { return c.param.name; });

} // namespace
} // namespace gnomon
