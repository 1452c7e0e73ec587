// What frames share with those of other scenes changes none of them.
#include <cmath>

#include "protocol/json/json_codec.h"
#include "renderer/render.h"
#include "tests/support/glb_builder.h"
#include "tests/support/png_of.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

/// A box on a floor. What may differ between two files of the same meshes:
struct Variation {
  double camera = 0; ///< places of these, metres
  double box = 0;
  double red = 1;      ///< of the floor's color
  double height = 0.5; ///< of the box: another mesh
  bool coarse = false; ///< the floor's texture has another filter
};

Bytes checkered() {
  Image image{8, 8, {"R", "G", "B"}, std::vector<std::uint8_t>(192)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = (i / 3 + i / 24) % 2 == 0 ? 250 : 90;
  return *encodePng(image, 1);
}

testing::GlbBuilder boxOnFloor(const Variation& variation) {
  testing::GlbBuilder file = testing::plane();
  file.json["nodes"][0]["scale"] = {4, 1, 4};
  file.add("images", {{"bufferView", file.addView(checkered())}, {"mimeType", "image/png"}});
  file.add("samplers", {{"magFilter", variation.coarse ? 9728 : 9729}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  const int material =
      file.add("materials", {{"pbrMetallicRoughness",
                              {{"baseColorFactor", {variation.red, 1, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}});
  file.json["meshes"][0]["primitives"][0]["material"] = material;
  const auto h = static_cast<float>(variation.height);
  const int points = file.addPoints({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0, 2 * h, 0}});
  const int indices = file.addIndices({0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0, 0, 1, 2, 0, 2, 3});
  const int mesh = file.addMesh({{"attributes", {{"POSITION", points}}}, {"indices", indices}});
  file.json["nodes"][static_cast<std::size_t>(file.addMeshNode(mesh))]["translation"] = {variation.box, 0.1, 0};
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  file.addRoot({{"name", "eye"},
                {"camera", 0},
                {"translation", {variation.camera, 3, 4}},
                {"rotation", {-std::sin(0.3), 0, 0, std::cos(0.3)}}});
  return file;
}

std::vector<Bytes> pictures(Renderer& renderer, const ScenePtr& scene) {
  const auto spec = decodeFrameSpec(R"({"width":120,"height":80,"camera":{"node":"eye"},
    "views":["color","depth","ids","atlas","reference"],"lights":[{"direction":[-0.5,-1,-0.2]}]})");
  EXPECT_TRUE(spec);
  const auto frame = renderer.render(scene, spec ? *spec : FrameSpec{});
  EXPECT_TRUE(frame) << frame.problems().front().detail;
  std::vector<Bytes> files;
  for (std::size_t i = 0; frame && i < frame->images.size(); ++i) files.push_back(testing::pngOf(*frame, i));
  return files;
}

/// Of every variation, one after the other by one renderer, which may still have the others' scenes.
std::vector<std::vector<Bytes>> allPictures(KnownContent* known) {
  auto renderer = Renderer::create({.backend = testing::testedBackend()});
  EXPECT_TRUE(renderer) << renderer.problems().front().detail;
  std::vector<std::vector<Bytes>> all;
  std::vector<ScenePtr> kept;
  for (const Variation& variation :
       {Variation{}, Variation{.camera = 1}, Variation{.box = 1}, Variation{.camera = -1}, Variation{.red = 0.2},
        Variation{.coarse = true}, Variation{.height = 1}, Variation{.camera = 1, .box = 1}, Variation{}}) {
    const auto scene = loadScene(boxOnFloor(variation).bundle(), kLimits, {}, {}, known);
    EXPECT_TRUE(scene);
    if (!renderer || !scene) break;
    kept.push_back(*scene);
    all.push_back(pictures(*renderer, *scene));
  }
  return all;
}

TEST(KnownContentFrames, AreThoseOfFilesThatWereLoadedAlone) {
  KnownContent known;
  const auto shared = allPictures(&known);
  EXPECT_EQ(known.reused().images, 8u);
  EXPECT_EQ(known.reused().meshes, 15u);
  const auto alone = allPictures(nullptr);
  ASSERT_EQ(shared.size(), 9u);
  ASSERT_EQ(alone.size(), 9u);
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(shared[i], alone[i]) << i;
  EXPECT_EQ(shared.front(), shared.back());
  for (std::size_t i = 1; i + 1 < alone.size(); ++i)
    EXPECT_NE(alone[i], alone[i - 1]) << "they differ in what they show";
}

} // namespace
} // namespace gnomon
