// Every tests/golden/NAME.json is a case: a scene, `files` beside it, a request that any client could send, and how far
// the picture may be from NAME.png, which llvmpipe drew; `cpuTolerance`, with its reason, where the CPU device may be
// farther off. To accept new pictures, run with GNOMON_GOLDEN_UPDATE=1 and look at what changed.
#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "renderer/render.h"
#include "tests/support/compare_images.h"
#include "tests/support/files.h"
#include "tests/support/png_of.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
const fs::path kCases = GNOMON_GOLDEN_CASES;
const fs::path kScenes = GNOMON_TEST_SCENES;
const fs::path kResults =
    fs::path(GNOMON_GOLDEN_RESULTS) / (testing::testedDevice() == DeviceChoice::cpu ? "cpu" : "gl");

std::vector<std::string> caseNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCases)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct Drawn {
  Bytes png;
  bool byGpu = false;
};

Drawn renderCase(const Json& golden) {
  const auto spec = decodeFrameSpec(golden.at("request").dump());
  EXPECT_TRUE(spec) << spec.problems().front().pointer << ' ' << spec.problems().front().detail;
  SceneBundle bundle{testing::readFile(kScenes / (golden.at("scene").get<std::string>() + ".glb")), {}};
  for (const auto& file : golden.value("files", std::vector<std::string>{})) {
    bundle.files[file] = testing::readFile(kScenes / file);
  }
  const auto scene = loadScene(bundle);
  EXPECT_TRUE(scene) << scene.problems().front().detail;
  auto renderer = Renderer::create({.backend = testing::testedBackend()});
  EXPECT_TRUE(renderer) << renderer.problems().front().detail;
  if (!spec || !scene || !renderer) return {};
  const auto frame = renderer->render(*scene, *spec);
  EXPECT_TRUE(frame) << frame.problems().front().detail;
  if (!frame) return {};
  return {testing::pngOf(*frame), !renderer->info().software};
}

Image decoded(const Bytes& png) {
  return *decodeImage(png, 4096, 4096 * 4096);
}

struct Tolerance {
  int max = 0;            ///< levels
  double mean = 0;        ///< levels
  double shareBeyond = 0; ///< of the pixels: how many may differ by more than `max`
};

/// GPUs round colors to either level, and put edges elsewhere by up to a 256th of a pixel: a few pixels along
/// silhouettes show the other surface.
Tolerance toleranceOf(const Json& golden, bool byGpu) {
  const bool own = testing::testedDevice() == DeviceChoice::cpu && golden.contains("cpuTolerance");
  const Json& json = golden.at(own ? "cpuTolerance" : "tolerance");
  Tolerance tolerance{json.at("max").get<int>(), json.at("mean").get<double>()};
  if (byGpu) {
    tolerance.mean *= 2;
    tolerance.shareBeyond = 0.001;
  }
  return tolerance;
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, LooksAsItDid) {
  const Json golden = Json::parse(std::ifstream(kCases / (GetParam() + ".json")));
  const auto [png, byGpu] = renderCase(golden);
  ASSERT_FALSE(png.empty());
  const fs::path reference = kCases / (GetParam() + ".png");
  const bool drawnAnew =
      std::getenv("GNOMON_GOLDEN_UPDATE") != nullptr && testing::testedDevice() == DeviceChoice::gl && !byGpu;
  if (drawnAnew) testing::writeFile(reference, png);
  ASSERT_TRUE(fs::exists(reference)) << "no reference picture; run with GNOMON_GOLDEN_UPDATE=1 and look at it";

  const Image expected = decoded(testing::readFile(reference));
  const Image actual = decoded(png);
  const testing::ImageDifference difference = testing::compareImages(expected, actual);
  ASSERT_TRUE(difference.sameSize);
  const Tolerance tolerance = toleranceOf(golden, byGpu);
  const double beyond = testing::shareBeyond(expected, actual, tolerance.max);
  const bool close = beyond <= tolerance.shareBeyond && difference.mean <= tolerance.mean;
  if (!close) {
    fs::create_directories(kResults);
    testing::writeFile(kResults / (GetParam() + ".png"), png);
    testing::writeFile(kResults / (GetParam() + "_difference.png"),
                       *encodePng(testing::differenceMap(expected, actual), 2));
  }
  EXPECT_TRUE(close) << "max " << difference.max << " (" << tolerance.max << " but for " << tolerance.shareBeyond
                     << " of the pixels, and it are " << beyond << "), mean " << difference.mean << " ("
                     << tolerance.mean << "), worst at " << difference.worstX << ',' << difference.worstY
                     << "; the picture and a map of the difference are in " << kResults;
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, ::testing::ValuesIn(caseNames()), [](const auto& c) { return c.param; });

} // namespace
} // namespace gnomon
