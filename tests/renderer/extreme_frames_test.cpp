// Files and requests with extreme numbers, drawn whole: each is a picture or a problem, and never the end of the
// process. The fuzz target `extremes` looks for more of the same.
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/extreme_frame.h"

namespace gnomon {
namespace {

Renderer& renderer() {
  static Renderer made = *Renderer::create(
      {.backend = {.device = DeviceChoice::cpu}, .gpuSceneBytes = 0, .tracedSceneBytes = 0, .tileCacheBytes = 0});
  return made;
}

/// What is wrong with how this frame ends, if anything.
std::string faultOf(const testing::ExtremeFrame& frame, int& pictures) {
  const auto spec = decodeFrameSpec(frame.spec.dump());
  if (!spec) return "";
  const auto faultIn = [](const Problems& problems) {
    const Problem& first = problems.front();
    return first.code == ProblemCode::internal ? first.pointer + ": " + first.detail : "";
  };
  const auto scene = loadScene(frame.bundle);
  if (!scene) return faultIn(scene.problems());
  if (spec->quality) {
    const EvaluationTools tools = evaluationTools(renderer(), *scene);
    const auto chosen = chooseQuality(*spec, [&](const Evaluation& evaluation) {
      return evaluate(*scene, evaluation, renderer().info(), tools, {});
    });
    return chosen ? "" : faultIn(chosen.problems());
  }
  const auto drawn = renderer().render(*scene, *spec);
  if (!drawn) return faultIn(drawn.problems());
  const auto files = encodePictures(*drawn, 16);
  if (!files) return faultIn(files.problems());
  ++pictures;
  return "";
}

TEST(ExtremeFrames, AnyFiniteNumberGivesAPictureOrAProblem) {
  constexpr std::uint32_t kFrames = 2000;
  int pictures = 0;
  for (std::uint32_t seed = 0; seed < kFrames; ++seed) {
    std::fprintf(stderr, "seed %u\n", seed); // the last one in the log of a process that ended
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes(1800);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(faultOf(testing::extremeFrame(bytes), pictures), "") << "seed " << seed;
  }
  EXPECT_GT(pictures, 400) << "most were refused: little was drawn";
}

} // namespace
} // namespace gnomon
