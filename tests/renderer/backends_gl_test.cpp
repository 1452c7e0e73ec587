// EGL and OSMesa are equals: the same frame, to the byte. A program of its own, since a process has one context at a
// time.
#include <gtest/gtest.h>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/files.h"
#include "tests/support/png_of.h"

namespace gnomon {
namespace {

Result<std::vector<Bytes>> picturesBy(Backend backend) {
  auto renderer = Renderer::create({.backend = {.backend = backend}});
  if (!renderer) return renderer.problems();
  std::vector<Bytes> pictures;
  for (const char* name : {"long_row", "mask_leaf", "normal_mapped"}) {
    const auto scene = loadScene({testing::readFile(std::string(GNOMON_TEST_SCENES "/") + name + ".glb"), {}});
    const auto spec = decodeFrameSpec(R"({"width":160,"height":90,"camera":{"node":"camera"},
        "views":["color","cascades","depth","shadow","atlas"]})");
    const auto frame = renderer->render(*scene, *spec);
    if (!frame) return frame.problems();
    for (std::size_t view = 0; view < frame->images.size(); ++view) pictures.push_back(testing::pngOf(*frame, view));
  }
  return pictures;
}

TEST(Backends, H5_EglAndOsMesaDrawTheSameBytes) {
  const auto egl = picturesBy(Backend::egl);
  if (!egl) GTEST_SKIP() << "no EGL here: " << egl.problems().front().detail;
  const auto osmesa = picturesBy(Backend::osmesa);
  if (!osmesa) GTEST_SKIP() << "no OSMesa here: " << osmesa.problems().front().detail;
  const auto again = picturesBy(Backend::egl);
  ASSERT_TRUE(again);
  EXPECT_EQ(*egl, *again);
  const auto info = Renderer::create({.backend = {.backend = Backend::egl}});
  if (!info->info().software) GTEST_SKIP() << "EGL has a GPU; software draws other bytes";
  EXPECT_EQ(*egl, *osmesa);
}

} // namespace
} // namespace gnomon
