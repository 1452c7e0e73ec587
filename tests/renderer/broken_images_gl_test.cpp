#include <gmock/gmock.h>

#include "protocol/spec/enum_rows.h"
#include "renderer/image/picture_encode.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

/// A plane of one metre with a texture whose header and structure hold, and whose pixels don't.
testing::GlbBuilder brokenPlane(const char* alphaMode) {
  const Image grey{8, 8, {"R", "G", "B"}, std::vector<std::uint8_t>(8 * 8 * 3, 128)};
  Bytes png = *encodePng(grey, 1);
  png[png.size() - 20] ^= 0xff; // of the pixels, or their checksum
  testing::GlbBuilder plane = testing::plane();
  plane.add("images", {{"bufferView", plane.addView(png)}, {"mimeType", "image/png"}});
  plane.add("textures", {{"source", 0}});
  plane.add("materials", {{"alphaMode", alphaMode}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  plane.json["meshes"][0]["primitives"][0]["material"] = 0;
  return plane;
}

std::string specOn(const char* device, const char* target, View view = View::color) {
  return R"({"width":32,"height":32,"camera":{"eye":[0,7,0],"up":[0,0,-1],"target":)" + std::string(target) +
         R"(},"device":")" + device + R"(","views":[")" + std::string(spell(view)) + "\"]}";
}

/// Drawn by the device that the spec names.
Result<Frame> rendered(const ScenePtr& scene, const std::string& spec) {
  static Renderer cpu = *Renderer::create({.backend = {.device = DeviceChoice::cpu}});
  static Renderer gl = *Renderer::create({.backend = {.device = DeviceChoice::gl}});
  const auto decoded = decodeFrameSpec(spec);
  if (!decoded) return decoded.problems();
  return (decoded->device == DeviceChoice::cpu ? cpu : gl).render(scene, *decoded);
}

constexpr const char* kDown = "[0,0,0]";
constexpr const char* kUp = "[0,14,0]";

TEST(BrokenImages, AreDrawnAsFarAsTheyGoWithAWarning) {
  for (const char* alphaMode : {"OPAQUE", "MASK"}) {
    const ScenePtr scene = testing::sceneOf(brokenPlane(alphaMode));
    for (const char* device : {"cpu", "gl"}) {
      for (int i = 0; i < 2; ++i) {
        const auto frame = rendered(scene, specOn(device, kDown));
        ASSERT_TRUE(frame) << device << ": " << frame.problems().front().detail;
        EXPECT_THAT(frame->report.warnings, ::testing::Contains(::testing::HasSubstr("/images/0"))) << device;
      }
    }
  }
}

TEST(BrokenImages, DoNotMatterWhereTheProcessorNeedNotReadThem) {
  const ScenePtr scene = testing::sceneOf(brokenPlane("OPAQUE"));
  const auto frame = rendered(scene, specOn("cpu", kUp));
  ASSERT_TRUE(frame) << frame.problems().front().detail;
  EXPECT_THAT(frame->report.warnings, Not(::testing::Contains(::testing::HasSubstr("/images/0"))));
}

} // namespace
} // namespace gnomon
