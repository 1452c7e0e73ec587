#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>
#include <unistd.h>

#include "gl_fixture.h"
#include "renderer/gl/context.h"
#include "renderer/gl/object.h"
#include "triangle.h"

namespace gnomon::gl {
namespace {

using ::testing::HasSubstr;

std::unique_ptr<Context> made(Backend backend) {
  Result<std::unique_ptr<Context>> context = createContext({.backend = backend});
  if (context) return *std::move(context);
  ADD_FAILURE() << detailsOf(context.problems());
  return nullptr;
}

std::vector<std::byte> triangleOf(Backend backend) {
  const auto context = made(backend);
  if (!context) return {};
  const auto pixels = drawTriangles();
  EXPECT_THAT(takeDebugErrors(), testing::IsEmpty());
  if (pixels) return *pixels;
  ADD_FAILURE() << detailsOf(pixels.problems());
  return {};
}

/// Memory of this process that is in RAM, bytes.
long residentBytes() {
  long total = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

class EachBackend : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    if (const std::string why = missing(GetParam()); !why.empty()) GTEST_SKIP() << why;
  }
};
INSTANTIATE_TEST_SUITE_P(Context, EachBackend, testing::Values(Backend::egl, Backend::osmesa),
                         [](const auto& param) { return param.param == Backend::egl ? "egl" : "osmesa"; });

TEST_P(EachBackend, saysWhatItIs) {
  const auto context = made(GetParam());
  ASSERT_TRUE(context);
  const RendererInfo& info = context->info();
  EXPECT_EQ(info.backend, GetParam() == Backend::egl ? "egl" : "osmesa");
  EXPECT_THAT(info.platform, testing::AnyOf("device", "surfaceless", "osmesa"));
  EXPECT_FALSE(info.vendor.empty());
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_THAT(info.version, HasSubstr("4."));
  EXPECT_GE(info.maxTextureSize, 16384);
  EXPECT_GE(info.maxSamples, 4);
  EXPECT_THAT(info.fingerprint, testing::MatchesRegex("[0-9a-f]{16}"));
}

TEST_P(EachBackend, clipsDepthFromZeroToOne) {
  const auto context = made(GetParam());
  ASSERT_TRUE(context);
  GLint depth = 0;
  GLint origin = 0;
  glGetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
  glGetIntegerv(GL_CLIP_ORIGIN, &origin);
  EXPECT_EQ(depth, GL_ZERO_TO_ONE);
  EXPECT_EQ(origin, GL_LOWER_LEFT);
}

TEST_P(EachBackend, fingerprintIsTheSameEachTime) {
  const std::string first = made(GetParam())->info().fingerprint;
  EXPECT_EQ(made(GetParam())->info().fingerprint, first);
}

TEST_P(EachBackend, isMadeAndDestroyedWithoutGrowing) {
  constexpr int kWarmUp = 10;
  constexpr int kCycles = 50;
  long before = 0;
  for (int i = 0; i < kWarmUp + kCycles; ++i) {
    if (i == kWarmUp) before = residentBytes();
    ASSERT_TRUE(made(GetParam()));
  }
  EXPECT_LT(residentBytes() - before, 16L << 20);
}

TEST_P(EachBackend, drawsTheSameOnSeveralThreadsAtOnce) {
  const std::vector<std::byte> alone = triangleOf(GetParam());
  std::vector<std::byte> first;
  std::vector<std::byte> second;
  std::thread a([&] { first = triangleOf(GetParam()); });
  std::thread b([&] { second = triangleOf(GetParam()); });
  a.join();
  b.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

TEST_P(EachBackend, isRefusedOnAThreadThatHasOne) {
  const auto first = made(GetParam());
  const auto second = createContext({.backend = GetParam()});
  ASSERT_FALSE(second);
  EXPECT_THAT(detailsOf(second.problems()), HasSubstr("already has a graphics context"));
  EXPECT_TRUE(drawTriangles()) << "the first context must still be current";
}

TEST(Context, isRefusedBesideAnotherBackend) {
  if (!missing(Backend::egl).empty() || !missing(Backend::osmesa).empty()) GTEST_SKIP() << "one back end is missing";
  const auto first = made(Backend::egl);
  std::thread([] {
    const auto second = createContext({.backend = Backend::osmesa});
    ASSERT_FALSE(second);
    EXPECT_THAT(detailsOf(second.problems()), HasSubstr("already uses another back end"));
  }).join();
}

TEST(Context, refusesSoftwareWhereAGpuIsRequired) {
  const auto context = createContext({.backend = Backend::auto_, .requireGpu = true});
  if (context) {
    EXPECT_FALSE((*context)->info().software) << (*context)->info().renderer;
    return;
  }
  ASSERT_EQ(context.problems().size(), 1u);
  EXPECT_EQ(context.problems().front().code, ProblemCode::backend);
  const std::string& detail = context.problems().front().detail;
  EXPECT_THAT(detail, HasSubstr("EGL"));
  EXPECT_THAT(detail, HasSubstr("OSMesa"));
  EXPECT_THAT(detail, HasSubstr("a GPU is required"));
}

// EGL and OSMesa read their environment once a process, so this takes a process of its own.
TEST(ContextDeathTest, namesWhatWasTriedWhereNothingWorks) {
  if (!missing(Backend::egl).empty()) GTEST_SKIP() << missing(Backend::egl);
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/no/such/vendor.json", 1);
        const auto context = createContext({.backend = Backend::egl});
        if (context) std::exit(1);
        std::cerr << context.problems().size() << ": " << context.problems().front().detail;
        std::exit(context.problems().front().code == ProblemCode::backend ? 0 : 1);
      },
      testing::ExitedWithCode(0), "1: no graphics context could be made: EGL.*\\.$");
}

} // namespace
} // namespace gnomon::gl
