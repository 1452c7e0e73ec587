// The CPU device alone: no OpenGL in this process, and the same bytes whoever draws them.
#include <fstream>
#include <gmock/gmock.h>
#include <sstream>
#include <tbb/global_control.h>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/files.h"
#include "tests/support/png_of.h"

namespace gnomon {
namespace {

Result<Renderer> rendererBy(DeviceChoice device, std::size_t tileBytes = 0) {
  return Renderer::create({.backend = {.device = device}, .tileCacheBytes = tileBytes});
}

ScenePtr sceneNamed(const std::string& name) {
  auto scene = loadScene({testing::readFile(std::string(GNOMON_TEST_SCENES "/") + name + ".glb"), {}});
  EXPECT_TRUE(scene);
  return scene ? *scene : nullptr;
}

FrameSpec specOf(const std::string& json) {
  const auto spec = decodeFrameSpec(json);
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  return spec ? *spec : FrameSpec{};
}

const char* const kManyViews =
    R"({"width":213,"height":121,"views":["color","depth","normal","shadow","cascades","atlas"],
    "lights":[{"sun":{"azimuthDegrees":120,"elevationDegrees":35}},
              {"type":"point","position":[1.5,4.2,2.5],"intensity":300,"shadow":{"filter":{"type":"msm"}}},
              {"type":"spot","position":[3,4,2],"direction":[-3,-4,-2],"range":20,"shadow":{"technique":"rayTraced"}}]})";

std::vector<Bytes> picturesBy(Renderer& renderer, const ScenePtr& scene) {
  const auto frame = renderer.render(scene, specOf(kManyViews));
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  std::vector<Bytes> pictures;
  for (std::size_t i = 0; frame && i < frame->images.size(); ++i) pictures.push_back(testing::pngOf(*frame, i));
  return pictures;
}

TEST(CpuDevice, H5_AnyNumberOfThreadsGivesTheSameBytes) {
  for (const char* name : {"box_on_plane", "long_row", "mask_leaf", "normal_mapped", "city"}) {
    const ScenePtr scene = sceneNamed(name);
    std::vector<Bytes> alone;
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      auto renderer = rendererBy(DeviceChoice::cpu);
      ASSERT_TRUE(renderer);
      alone = picturesBy(*renderer, scene);
    }
    auto renderer = rendererBy(DeviceChoice::cpu);
    ASSERT_TRUE(renderer);
    EXPECT_EQ(alone, picturesBy(*renderer, scene)) << name;
  }
}

TEST(CpuDevice, H5_ASecondFrameHasTheSameBytes) {
  auto renderer = rendererBy(DeviceChoice::cpu, std::size_t{1} << 28);
  ASSERT_TRUE(renderer);
  for (const char* name : {"long_row", "mask_leaf"}) {
    const ScenePtr scene = sceneNamed(name);
    const std::vector<Bytes> first = picturesBy(*renderer, scene);
    picturesBy(*renderer, sceneNamed("lights"));
    EXPECT_EQ(first, picturesBy(*renderer, scene)) << name;
  }
}

TEST(CpuDevice, HasNoGpuAndNoContextOfOpenGl) {
  EXPECT_FALSE(Renderer::create({.backend = {.device = DeviceChoice::cpu, .requireGpu = true}}));
  EXPECT_FALSE(Renderer::create({.backend = {.device = DeviceChoice::cpu, .backend = Backend::osmesa}}));
}

TEST(CpuDevice, TheReportSaysWhatDrew) {
  auto renderer = rendererBy(DeviceChoice::cpu);
  ASSERT_TRUE(renderer);
  EXPECT_EQ(renderer->info().device, DeviceChoice::cpu);
  EXPECT_EQ(renderer->info().backend, "cpu");
  EXPECT_TRUE(renderer->info().software);
  for (const char* device : {"auto", "cpu"}) {
    const auto frame = renderer->render(sceneNamed("box_on_plane"),
                                        specOf(R"({"width":16,"height":16,"device":")" + std::string(device) + "\"}"));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->report.spec.device, DeviceChoice::cpu);
  }
}

TEST(CpuDevice, WhatItDoesNotDrawIsAProblemWithItsPlace) {
  for (const DeviceChoice choice : {DeviceChoice::cpu, DeviceChoice::auto_}) {
    auto renderer = rendererBy(choice);
    ASSERT_TRUE(renderer);
    const bool namesCpu = renderer->info().device == DeviceChoice::gl; // a GPU draws what is left open
    const ScenePtr box = sceneNamed("box_on_plane");
    const auto byGl = renderer->render(box, specOf(R"({"device":"gl"})"));
    ASSERT_EQ(static_cast<bool>(byGl), namesCpu);
    if (!byGl) {
      EXPECT_EQ(byGl.problems()[0].pointer, "/device");
      EXPECT_EQ(byGl.problems()[0].code, ProblemCode::unsupportedFeature);
    }
    for (const char* device : {"auto", "cpu"}) {
      if (namesCpu && device == std::string("auto")) continue;
      const auto volumes = renderer->render(
          box, specOf(R"({"shadow":{"technique":"shadowVolume"},"device":")" + std::string(device) + "\"}"));
      ASSERT_FALSE(volumes);
      EXPECT_EQ(volumes.problems()[0].pointer, "/shadow/technique");
      EXPECT_EQ(volumes.problems()[0].code, ProblemCode::unsupportedFeature);
      EXPECT_THAT(volumes.problems()[0].detail,
                  ::testing::AllOf(::testing::HasSubstr("cpu"), ::testing::HasSubstr("shadowVolume"),
                                   ::testing::HasSubstr("--device gl")));
    }
  }
}

/// Last, after frames were drawn; a renderer that may choose loads no driver either where there is no GPU.
TEST(CpuDevice, NoOpenGlIsLoaded) {
  auto automatic = rendererBy(DeviceChoice::auto_);
  ASSERT_TRUE(automatic);
  if (automatic->info().device == DeviceChoice::gl) GTEST_SKIP() << "a GPU draws here";
  ASSERT_TRUE(automatic->render(sceneNamed("box_on_plane"), specOf(R"({"width":16,"height":16})")));
  std::stringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  for (const char* library : {"libEGL", "libGL.", "libGLX", "libOSMesa", "libgallium", "_dri.so"}) {
    EXPECT_EQ(maps.str().find(library), std::string::npos) << library;
  }
}

} // namespace
} // namespace gnomon
