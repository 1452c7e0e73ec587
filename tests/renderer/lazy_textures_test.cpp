// The processor makes only those sizes of a texture that a picture reads: which ones others read before changes
// nothing.
#include <gtest/gtest.h>
#include <random>

#include "protocol/json/json_codec.h"
#include "renderer/image/picture_encode.h"
#include "renderer/render.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

/// A plane of two metres with a texture of 256 x 128 texels.
ScenePtr texturedPlane() {
  std::mt19937 random(5);
  Image noise{256, 128, {"R", "G", "B"}, std::vector<std::uint8_t>(256 * 128 * 3)};
  for (std::uint8_t& byte : std::get<0>(noise.pixels)) byte = static_cast<std::uint8_t>(random());
  testing::GlbBuilder plane = testing::plane();
  plane.add("images", {{"bufferView", plane.addView(*encodePng(noise, 1))}, {"mimeType", "image/png"}});
  plane.add("textures", {{"source", 0}});
  plane.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  plane.json["meshes"][0]["primitives"][0]["material"] = 0;
  auto scene = loadScene({plane.glb(), {}});
  if (!scene) throw std::runtime_error(scene.problems()[0].detail);
  return *scene;
}

Renderer processor() {
  auto renderer = Renderer::create({.backend = {.device = DeviceChoice::cpu}});
  if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
  return std::move(*renderer);
}

/// From `height` metres over the plane.
Frame drawn(Renderer& renderer, const ScenePtr& scene, double height) {
  const Json spec = {{"width", 64},
                     {"height", 64},
                     {"camera", {{"eye", {0.1, height, 0.2}}, {"up", {0, 0, -1}}, {"target", {0, 0, 0}}}},
                     {"antialiasing", height > 4 ? "msaa4x" : "none"}};
  auto frame = renderer.render(scene, *decodeFrameSpec(spec.dump()));
  EXPECT_TRUE(frame);
  return std::move(*frame);
}

TEST(LazyTextures, APictureIsTheSameWhateverOthersReadBefore) {
  const std::vector<double> heights{40, 1.2, 9, 0.1, 3, 300};
  Renderer all = processor();
  const ScenePtr scene = texturedPlane();
  for (const double height : heights) {
    Renderer first = processor();
    const Frame after = drawn(all, scene, height);
    const Frame alone = drawn(first, texturedPlane(), height);
    EXPECT_EQ(after.images[0].image.pixels, alone.images[0].image.pixels) << height;
  }
}

TEST(LazyTextures, FromFarAwayFewTexelsAreKept) {
  std::vector<std::uint64_t> bytes;
  for (const double height : {300.0, 9.0, 1.2}) {
    Renderer renderer = processor();
    bytes.push_back(drawn(renderer, texturedPlane(), height).report.memory.scene);
  }
  EXPECT_LT(bytes[0], 500u);
  EXPECT_GT(bytes[1], 8 * bytes[0]);
  EXPECT_GT(bytes[2], 4 * bytes[1]);
}

} // namespace
} // namespace gnomon
