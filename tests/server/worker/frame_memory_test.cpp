#include "server/worker/frame_memory.h"

#include <functional>
#include <gtest/gtest.h>
#include <memory>

#include "server/worker/orders.h"

namespace gnomon {
namespace {

constexpr std::size_t kPixels = 400 * 200;

/// One point light without a shadow.
FrameSpec unshadowed() {
  FrameSpec spec;
  spec.width = 400;
  spec.height = 200;
  spec.antialiasing = Antialiasing::none;
  spec.shadow.enabled = false;
  return spec;
}

std::size_t bytesOf(const FrameSpec& spec, const SceneSummary& scene = {}) {
  return frameBytes(spec, scene, DeviceKind::processor);
}

/// What a change adds, in bytes for each pixel.
std::size_t added(FrameSpec spec, const std::function<void(FrameSpec&)>& change) {
  const std::size_t before = bytesOf(spec);
  change(spec);
  return (bytesOf(spec) - before) / kPixels;
}

TEST(FrameMemory, CountsPicturesAndSamples) {
  const FrameSpec spec = unshadowed();
  EXPECT_EQ(added(spec, [](FrameSpec& each) { each.antialiasing = Antialiasing::msaa4x; }), 3u * 8);
  EXPECT_EQ(added(spec, [](FrameSpec& each) { each.views.push_back(View::normal); }), 3u + 3) << "and its file";
  EXPECT_EQ(added(spec, [](FrameSpec& each) { each.output.pngBits = 16; }), 4u + 4);
  FrameSpec smooth = spec;
  smooth.antialiasing = Antialiasing::msaa4x;
  EXPECT_EQ(added(smooth, [](FrameSpec& each) { each.views.push_back(View::normal); }), 8u + 3 + 3)
      << "a view of data has samples of its own";
}

TEST(FrameMemory, CountsWhatEncodingHolds) {
  const FrameSpec spec = unshadowed();
  const auto as = [&](ImageFormat format) {
    return added(spec, [&](FrameSpec& each) {
      each.output.format = format;
      each.views = {View::color, View::depth};
    });
  };
  const std::size_t floats = 4 * sizeof(float) + sizeof(float); // color with alpha, depth
  EXPECT_EQ(as(ImageFormat::exr) - as(ImageFormat::png), 3 * floats - 2 * 5) << "a part of all, a file that grows";
  EXPECT_GT(as(ImageFormat::tiff), as(ImageFormat::npy));
  EXPECT_EQ(frameBytes(spec, {}, DeviceKind::processor, true) > bytesOf(spec), true) << "as text it is copied";
}

TEST(FrameMemory, CountsLayersTilesAndMoments) {
  FrameSpec spec = unshadowed();
  spec.lights = {Light{}};
  spec.shadow.enabled = true;
  spec.shadow.technique = ShadowTechnique::shadowMap;
  spec.atlas = {.size = 2048, .baseSize = 2048};
  spec.shadow.size = ShadowSize::XLarge;
  const std::size_t mapped = bytesOf(spec);
  spec.shadow.filter.type = FilterType::evsm;
  EXPECT_GT(bytesOf(spec), mapped + 16 * 1024 * 1024) << "moments";
  spec.shadow.filter = {};
  spec.shadow.technique = ShadowTechnique::rayTraced;
  const std::size_t traced = bytesOf(spec);
  spec.lights->resize(3);
  EXPECT_EQ(bytesOf(spec) - traced, 2 * kPixels * 2) << "a layer for each further light";
}

TEST(FrameMemory, CountsVolumesAndTheLightInThem) {
  SceneSummary scene;
  scene.volumeFiles = {"a.npy"};
  scene.memory.volumes = 32 << 20;
  FrameSpec spec = unshadowed();
  const std::size_t before = bytesOf(spec, scene);
  spec.volumes.resize(2);
  EXPECT_GT(bytesOf(spec, scene), before + (32 << 20) + 2 * (4 << 20));
}

TEST(FrameMemory, CountsTheEnvironment) {
  SceneSummary scene;
  scene.memory.environments = 32 << 20;
  FrameSpec spec = unshadowed();
  const std::size_t before = bytesOf(spec, scene);
  spec.environment.file = "sky.hdr";
  EXPECT_GE(bytesOf(spec, scene), before + (32 << 20) + (50 << 20)) << "and what is prepared";
  EXPECT_LT(bytesOf(spec, scene), before + (32 << 20) + (70 << 20));
  // The glTF's own light, unless the studio is named.
  spec.environment = {};
  scene.environmentLight = 0;
  EXPECT_GE(bytesOf(spec, scene), before + (32 << 20) + (50 << 20));
  spec.environment.studio = Studio::even;
  EXPECT_EQ(bytesOf(spec, scene), before);
}

TEST(FrameMemory, CountsWhatIsHiddenOfTheEnvironment) {
  const auto hidden = [](FrameSpec& each) { each.environment.shadows = EnvironmentShadows::rays; };
  EXPECT_EQ(added(unshadowed(), hidden), 27u + 8 - 4) << "less the file, which comes later";
  FrameSpec smooth = unshadowed();
  smooth.antialiasing = Antialiasing::msaa4x;
  EXPECT_EQ(added(smooth, hidden), 27u + 4 * 8 - 4);
}

TEST(FrameMemory, TheAtlasHasItsOwnSize) {
  FrameSpec spec = unshadowed();
  const std::size_t before = bytesOf(spec);
  spec.atlas.size = 8192;
  spec.views = {View::atlas};
  EXPECT_GE(bytesOf(spec), before + std::size_t{8192} * 8192 * 4 - kPixels * 4);
}

TEST(FrameMemory, RaysTakeMemoryOncePerFrame) {
  const auto with = [](std::vector<View> views) {
    return added(unshadowed(), [&](FrameSpec& each) { each.views = std::move(views); });
  };
  EXPECT_EQ(with({View::color, View::error}), 3u + 4 + kReferenceBytes - 4) << "less the file, which comes later";
  EXPECT_EQ(with({View::color, View::error, View::reference}), 3u + 4 + 1 + kReferenceBytes - 4);
}

TEST(FrameMemory, TheLargestDoesNotOverflow) {
  FrameSpec spec;
  spec.width = spec.height = spec.atlas.size = 65536;
  spec.views = {View::color, View::depth, View::normal, View::cascades, View::shadow, View::atlas};
  spec.output.format = ImageFormat::exr;
  EXPECT_GT(bytesOf(spec), 6ull * 65536 * 65536 * 16);
}

/// Carries an order out that fails for want of memory, `beside` another one or alone.
ProblemCode problemWithoutMemory(bool beside) {
  OrdersAtWork orders;
  const auto other = beside ? std::make_unique<Presence>(orders) : nullptr;
  const Presence own(orders);
  return noMemoryFor(own).code;
}

TEST(Orders, WithoutMemoryTheRequestIsTooLargeOnlyWhereItWasAlone) {
  EXPECT_EQ(problemWithoutMemory(false), ProblemCode::tooLarge);
  EXPECT_EQ(problemWithoutMemory(true), ProblemCode::unavailable);
  OrdersAtWork orders;
  const Presence first(orders);
  { const Presence second(orders); }
  EXPECT_EQ(noMemoryFor(first).code, ProblemCode::unavailable) << "another came and went meanwhile";
  const Presence third(orders);
  EXPECT_EQ(noMemoryFor(third).code, ProblemCode::unavailable) << "another was there before";
}

TEST(Orders, ASceneWithoutMemoryIsTooLargeOnlyWhereItWasLoadedAlone) {
  const Answer lacking{.problems = {noMemory("/images/3", "There is not enough memory for this image.")}};
  const Answer passed{.problems = {{ProblemCode::tooLarge, "/nodes", "Too many nodes.", "1..65536"}}};
  OrdersAtWork orders;
  {
    const Presence own(orders);
    EXPECT_EQ(judgedAnswer(lacking, own).problems.front().pointer, "/images/3") << "it says what was too large";
    EXPECT_EQ(judgedAnswer(lacking, own).problems.front().code, ProblemCode::tooLarge);
  }
  const Presence other(orders);
  const Presence own(orders);
  EXPECT_EQ(judgedAnswer(lacking, own).problems.front().code, ProblemCode::unavailable);
  EXPECT_EQ(judgedAnswer(passed, own).problems.front().code, ProblemCode::tooLarge) << "a limit stays one";
  EXPECT_TRUE(judgedAnswer({.body = "{}"}, own).problems.empty());
}

TEST(QualityChoices, RemembersTheLastThatWasUsed) {
  QualityChoices choices;
  QualityChoice choice;
  choice.report.chosen = 3;
  EXPECT_FALSE(choices.find("a"));
  choices.keep("a", choice);
  choices.keep("b", {});
  ASSERT_TRUE(choices.find("a"));
  EXPECT_EQ(choices.find("a")->report.chosen, 3u);
  for (int i = 0; i < 1023; ++i) choices.keep(std::to_string(i), {});
  EXPECT_TRUE(choices.find("a")) << "used after b";
  EXPECT_FALSE(choices.find("b"));
}

QualityChoice measuredIn(std::string view) {
  QualityChoice choice{std::move(view), {}};
  choice.report.met = true;
  choice.report.tried.resize(1);
  return choice;
}

TEST(QualityChoices, AnotherViewIsGivenTheSettingsAndNotThatTheTargetIsMet) {
  const QualityReport same = reusedReport(measuredIn("here"), "here");
  EXPECT_EQ(same.met, true);
  EXPECT_TRUE(same.cached);
  const QualityReport other = reusedReport(measuredIn("here"), "there");
  EXPECT_FALSE(other.met.has_value());
  EXPECT_TRUE(other.cached);
  EXPECT_EQ(other.tried.size(), 1u);
}

TEST(QualityChoices, AreReadAsTheyWereStored) {
  const auto read = readQualityChoice(textOf(measuredIn("here")));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->view, "here");
  EXPECT_EQ(read->report.met, true);
  for (const char* text : {"", "{}", "here", "here\n", "here\n{}"}) EXPECT_FALSE(readQualityChoice(text)) << text;
}

} // namespace
} // namespace gnomon
