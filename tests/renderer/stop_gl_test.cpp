// A frame that nobody wants any more ends at once, wherever it is, and leaves nothing behind that later frames show.
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/renderer/frame_fixture.h"
#include "tests/support/files.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

#ifdef GNOMON_SANITIZED
constexpr double kLatest = 250; // milliseconds from goOn's first false to the return
#else
constexpr double kLatest = 100;
#endif

double millisecondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

struct Attempt {
  bool stopped = false;
  double late = 0; ///< milliseconds from where it was to stop until it returned
};

/// Draws the frame, which nobody wants any more after `milliseconds`.
Attempt drawFor(Renderer& renderer, const ScenePtr& scene, const FrameSpec& spec, double milliseconds) {
  const auto start = Clock::now();
  const auto goOn = [&] { return millisecondsBetween(start, Clock::now()) < milliseconds; };
  const auto frame = renderer.render(scene, spec, TileUse::kept, goOn);
  const double took = millisecondsBetween(start, Clock::now());
  if (!frame) {
    EXPECT_EQ(frame.problems().front().code, ProblemCode::unavailable) << frame.problems().front().detail;
  }
  return {!frame, took - milliseconds};
}

Renderer freshRenderer() {
  auto renderer = Renderer::create({.backend = testing::testedBackend()});
  if (!renderer) throw std::runtime_error(renderer.problems().front().detail);
  return *std::move(renderer);
}

/// A context of its own needs a thread of its own.
void onAnotherThread(const std::function<void()>& task) {
  std::thread(task).join();
}

FrameSpec specOf(const Json& json) {
  const auto spec = decodeFrameSpec(json.dump());
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  return spec ? *spec : FrameSpec{};
}

struct Case {
  std::string name;
  Json spec;
  std::string scene = "city";
  bool onlyGl = false;
};

void PrintTo(const Case& of, std::ostream* out) {
  *out << of.name;
}

Json lamp(double x) {
  return {{"type", "point"}, {"position", {x, 12, 4}}, {"intensity", 4000},
          {"range", 200},    {"radius", 0.5},          {"shadow", {{"technique", "shadowMap"}, {"size", "Large"}}}};
}

Json specWith(const Json& shadow, const Json& patch = Json::object()) {
  Json spec = {
      {"width", 1280},
      {"height", 720},
      {"camera", {{"node", "camera"}}},
      {"lights", {{{"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 35}}}, {"angularDiameterDegrees", 2}}}},
      {"shadow", shadow},
      {"antialiasing", "msaa4x"},
      {"output", {{"format", "exr"}}}};
  spec.merge_patch(patch);
  return spec;
}

class StoppedFrame : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (GetParam().onlyGl) GNOMON_NEEDS_GL("shadow volumes are OpenGL's");
  }
};

TEST_P(StoppedFrame, EndsAFrameAtOnceAndTheNextOneIsAsIfItHadNotBeen) {
  const ScenePtr scene = testing::generatedScene(GetParam().scene);
  const FrameSpec spec = specOf(GetParam().spec);
  Frame expected;
  double whole = 0;
  onAnotherThread([&] {
    Renderer fresh = freshRenderer();
    const auto start = Clock::now();
    auto frame = fresh.render(scene, spec);
    whole = millisecondsBetween(start, Clock::now());
    ASSERT_TRUE(frame) << frame.problems().front().pointer << ' ' << frame.problems().front().detail;
    expected = *std::move(frame);
  });
  onAnotherThread([&] {
    Renderer renderer = freshRenderer();
    FrameSpec small = spec; // for the drivers' compilers, which can't be stopped
    small.width = 80;
    small.height = 45;
    small.shadow.lightMap.samples = 1; // another bake
    ASSERT_TRUE(renderer.render(scene, small));
    int stopped = 0;
    const double latest = std::max(kLatest, whole / 40); // a draw call of a slow machine takes longer, too
    for (const double share : {0.05, 0.25, 0.5, 0.75}) {
      // The machine may be busy with something else, but not each time.
      double least = 1e9;
      for (int attempt = 0; attempt < 3 && least > latest; ++attempt) {
        const Attempt made = drawFor(renderer, scene, spec, share * whole);
        stopped += made.stopped ? 1 : 0;
        least = std::min(least, made.late);
      }
      EXPECT_LE(least, latest) << "stopped after " << share * whole << " of " << whole << " ms";
    }
    EXPECT_GE(stopped, 1);
    const auto frame = renderer.render(scene, spec);
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->images.size(), expected.images.size());
    for (std::size_t i = 0; i < expected.images.size(); ++i) {
      EXPECT_TRUE(frame->images[i].image.pixels == expected.images[i].image.pixels) << "view " << i;
    }
  });
}

const std::vector<Case>& cases() {
  static const Json kMany = {{"lights", {{{"sun", {{"elevationDegrees", 35}}}}, lamp(-8), lamp(-4), lamp(0), lamp(4)}}};
  static const std::vector<Case> all{
      {"ShadowMap", specWith({{"filter", {{"type", "pcss"}}}, {"size", "XLarge"}}, kMany)},
      {"Moments", specWith({{"filter", {{"type", "msm"}, {"size", 7}}}, {"size", "Large"}})},
      {"RayTraced", specWith({{"technique", "rayTraced"}, {"raySamples", 256}})},
      {"LightMap", specWith({{"technique", "lightMap"}, {"lightMap", {{"size", 1024}, {"samples", 256}}}}), "long_row"},
      {"ShadowVolume", specWith({{"technique", "shadowVolume"}}, kMany), "long_row", true},
      {"ErrorViews", specWith({{"technique", "shadowMap"}, {"size", "Large"}},
                              {{"width", 640},
                               {"height", 360},
                               {"views", {"error", "edgeDistance", "reference", "color"}},
                               {"debug", {{"predictEdges", true}}}})},
  };
  return all;
}

INSTANTIATE_TEST_SUITE_P(Frames, StoppedFrame, ::testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

/// How late `task(goOn)` ends that nobody wants any more after a share of its time, and whether it says so: the best of
/// three, since the machine may be busy with something else, but not each time.
template <class Task>
Attempt endAfter(double share, const Task& task) {
  Attempt best{false, 1e9};
  EXPECT_TRUE(task({})); // brings what is compiled or kept only once
  for (int attempt = 0; attempt < 3 && !(best.stopped && best.late <= kLatest); ++attempt) {
    const auto start = Clock::now();
    EXPECT_TRUE(task({}));
    const double until = share * millisecondsBetween(start, Clock::now());
    const auto again = Clock::now();
    const auto result = task([&] { return millisecondsBetween(again, Clock::now()) < until; });
    const Attempt made{!result, millisecondsBetween(again, Clock::now()) - until};
    if (made.stopped && made.late < best.late) best = made;
  }
  return best;
}

TEST(Stopping, EndsLoading) {
  const SceneBundle bundle{testing::generatedGlb("city"), {}};
  for (const double share : {0.1, 0.3, 0.5, 0.7}) {
    const Attempt made = endAfter(share, [&](const GoOn& goOn) { return loadScene(bundle, kLimits, {}, goOn); });
    EXPECT_TRUE(made.stopped) << share;
    EXPECT_LE(made.late, 2.5 * kLatest) << share;
  }
}

TEST(Stopping, EndsAShimmer) {
  const ScenePtr scene = testing::generatedScene("city");
  const FrameSpec spec = specOf(specWith({{"technique", "shadowMap"}, {"size", "XLarge"}}));
  const std::vector<Camera> path(6, spec.camera);
  onAnotherThread([&] {
    Renderer renderer = freshRenderer();
    for (const double share : {0.4, 0.6, 0.8}) {
      const Attempt made = endAfter(share, [&](const GoOn& goOn) {
        return renderer.shimmer(scene, spec, path, goOn ? Progress([&](double) { return goOn(); }) : Progress());
      });
      EXPECT_TRUE(made.stopped) << share;
      EXPECT_LE(made.late, 2.5 * kLatest) << share;
    }
  });
}

TEST(Stopping, EndsEncoding) {
  Frame frame;
  for (const View view : {View::color, View::normal}) {
    frame.images.push_back({view, {3000, 2000, {"R", "G", "B"}, std::vector<float>(18000000)}});
    auto& pixels = std::get<std::vector<float>>(frame.images.back().image.pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i * 2654435761u % 1000003u);
  }
  for (const ImageFormat format : {ImageFormat::exr, ImageFormat::png}) {
    frame.report.spec.output.format = format;
    if (format == ImageFormat::png) {
      for (ViewImage& each : frame.images) {
        std::vector<std::uint8_t> bytes(18000000);
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 2654435761u >> 13);
        each.image.pixels = std::move(bytes);
      }
    }
    for (const double share : {0.2, 0.5}) {
      const Attempt made = endAfter(share, [&](const GoOn& goOn) { return encodePictures(frame, 2, goOn); });
      EXPECT_TRUE(made.stopped) << share;
      EXPECT_LE(made.late, 2.5 * kLatest) << share;
    }
  }
}

} // namespace
} // namespace gnomon
