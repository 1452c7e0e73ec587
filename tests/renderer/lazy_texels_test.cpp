// The processor makes only those texels of a shadow map that a picture reads, and reads none where large surfaces lie
// open to the light: the picture is the one that it would be had every texel of every tile been made and read.
#include <random>

#include "protocol/json/json_codec.h"
#include "protocol/spec/traits.h"
#include "renderer/render.h"
#include "tests/support/chosen_spec.h"

namespace gnomon {
namespace {

Renderer processor(std::size_t tileBytes) {
  auto renderer = Renderer::create({.backend = {.device = DeviceChoice::cpu}, .tileCacheBytes = tileBytes});
  if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
  return std::move(*renderer);
}

std::vector<std::uint8_t> randomBytes(std::mt19937& random) {
  std::vector<std::uint8_t> bytes(1500);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// A frame that reads shadow maps: its scene, and a spec of views that show what the map says.
struct Mapped {
  ScenePtr scene;
  FrameSpec spec;
};

std::optional<Mapped> mappedFrame(std::mt19937& random) {
  testing::ChosenFrame chosen = testing::chosenFrame(randomBytes(random));
  if (random() % 4 != 0) chosen.spec["shadow"]["technique"] = "shadowMap";
  chosen.spec["atlas"]["samples"] = random() % 4 == 0 ? 4 : 1;
  chosen.spec["atlas"]["baseSize"] = 512;
  chosen.spec["views"] = {"color", "shadow", "cascades"};
  const auto scene = loadScene({chosen.glb, {}});
  const auto spec = decodeFrameSpec(chosen.spec.dump());
  if (!scene || !spec) return std::nullopt;
  return Mapped{*scene, *spec};
}

/// Every number of the views that both frames show, bit by bit.
void expectSameViews(const Frame& lazy, const Frame& whole, int index) {
  for (std::size_t view = 0; view < lazy.images.size(); ++view) {
    const Image& a = lazy.images[view].image;
    const Image& b = whole.images[view].image;
    ASSERT_EQ(a.pixels.index(), b.pixels.index());
    const bool same = a.width == b.width &&
                      std::visit(
                          [&](const auto& pixels) {
                            using Pixels = std::decay_t<decltype(pixels)>;
                            const auto& others = std::get<Pixels>(b.pixels);
                            return pixels.size() == others.size() &&
                                   std::memcmp(pixels.data(), others.data(), pixels.size() * sizeof(pixels[0])) == 0;
                          },
                          a.pixels);
    EXPECT_TRUE(same) << index << ", view " << spell(lazy.images[view].view) << ' ' << toJson(whole.report.spec).dump();
  }
}

TEST(LazyTexels, AFrameIsTheSameWhereEveryTexelWasMadeFirst) {
  Renderer lazy = processor(0);
  Renderer whole = processor(0);
  std::mt19937 random(13);
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    auto frame = mappedFrame(random);
    if (!frame) continue;
    const auto onDemand = lazy.render(frame->scene, frame->spec);
    frame->spec.views.push_back(View::atlas); // shows every texel
    const auto atOnce = whole.render(frame->scene, frame->spec);
    if (!onDemand || !atOnce) continue; // no light has a map, or the spec can't be drawn
    expectSameViews(*onDemand, *atOnce, i);
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

/// Floors, walls and steps, of a few large triangles each, flat or tilted, and things that stand on them: most of the
/// picture lies open to some light, and much of it within a filter's reach of what does not.
Mapped openGround(std::mt19937& random) {
  const auto within = [&](double first, double last) {
    return std::uniform_real_distribution<double>(first, last)(random);
  };
  const auto oneIn = [&](unsigned count) { return random() % count == 0; };
  testing::GlbBuilder builder = testing::cube();
  const testing::GlbBuilder square = testing::plane();
  builder.json["materials"] = {
      {{"doubleSided", true}},
      {{"doubleSided", true}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.3}},
      {{"doubleSided", true}, {"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.6}}}}}};
  const int points = builder.addPoints({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}});
  const int indices = builder.addIndices({0, 2, 1, 0, 3, 2});
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  for (const int material : {0, 1, 2}) {
    builder.addMesh({{"attributes", {{"POSITION", points}}}, {"indices", indices}, {"material", material}});
  }
  const std::array<double, 3> centre =
      oneIn(4) ? std::array<double, 3>{3e5, -2e4, 1e5} : std::array<double, 3>{0, 0, 0};
  const auto place = [&](int mesh, double size, double height, const std::array<double, 3>& at) {
    const double tilt = oneIn(3) ? within(-0.5, 0.5) : 0, turn = within(0, 3);
    const double shear = oneIn(4) ? within(-0.5, 0.5) : 0, flip = oneIn(4) ? -1 : 1;
    builder.addRoot({{"mesh", mesh},
                     {"matrix",
                      {flip * size * std::cos(turn), size * tilt, -flip * size * std::sin(turn), 0.0, height * shear,
                       height, 0.0, 0.0, size * std::sin(turn), 0.0, size * std::cos(turn), 0.0, centre[0] + at[0],
                       centre[1] + at[1], centre[2] + at[2], 1.0}}});
  };
  builder.json["nodes"] = nlohmann::json::array();
  builder.json["scenes"][0]["nodes"] = nlohmann::json::array();
  place(1, 10, 1, {0, 0, 0});
  for (int i = 0; i < 3; ++i)
    place(oneIn(2) ? 1 + static_cast<int>(random() % 3) : 0, within(1, 4), within(0.05, 3),
          {within(-6, 6), within(-0.5, 3), within(-6, 6)});
  for (int i = 0; i < 6; ++i) place(0, within(0.02, 1), within(0.1, 2), {within(-6, 6), within(0, 2), within(-6, 6)});

  nlohmann::json spec = {{"width", 320}, {"height", 240}, {"views", {"color", "shadow", "cascades"}}};
  const double azimuth = within(0, 360), elevation = within(5, 80);
  spec["camera"]["orbit"] = {{"azimuthDegrees", azimuth},
                             {"elevationDegrees", elevation},
                             {"distance", within(4, 20)},
                             {"target", {centre[0], centre[1], centre[2]}}};
  if (oneIn(3)) spec["camera"]["orthographic"] = {{"height", within(4, 14)}};
  spec["antialiasing"] = oneIn(2) ? "none" : "msaa4x";
  spec["lights"] = nlohmann::json::array();
  for (unsigned i = 0; i <= random() % 2; ++i) {
    spec["lights"].push_back(
        {{"type", "directional"},
         {"sun", {{"azimuthDegrees", within(0, 360)}, {"elevationDegrees", oneIn(3) ? within(1, 8) : within(8, 85)}}}});
  }
  nlohmann::json& shadow = spec["shadow"];
  shadow["cascadeCount"] = 1 + random() % 4;
  shadow["blendCascades"] = !oneIn(4);
  if (oneIn(3)) shadow["stabilization"] = oneIn(2) ? "projectionSnapping" : "viewSnapping";
  if (oneIn(4)) shadow["strength"] = 0.7;
  shadow["filter"] = {{"type", "pcf"}};
  if (oneIn(3)) {
    shadow["filter"]["radius"] = within(0.01, 0.5);
  } else {
    shadow["filter"]["size"] = 3 + 2 * (random() % 3);
  }
  spec["atlas"] = {{"baseSize", oneIn(2) ? 256 : 1024}, {"size", 4096}, {"samples", oneIn(4) ? 4 : 1}};
  const auto scene = loadScene({builder.glb(), {}});
  const auto decoded = decodeFrameSpec(spec.dump());
  if (!scene) throw std::runtime_error(scene.problems()[0].detail);
  if (!decoded) throw std::runtime_error(decoded.problems()[0].detail + spec.dump());
  return {*scene, *decoded};
}

TEST(LazyTexels, OpenGroundIsTheSameWhereItsTexelsAreRead) {
  Renderer lazy = processor(0);
  Renderer whole = processor(0);
  std::mt19937 random(15);
  for (int i = 0; i < 200; ++i) {
    Mapped frame = openGround(random);
    const auto untold = lazy.render(frame.scene, frame.spec);
    frame.spec.views.push_back(View::atlas); // then every texel is made and read
    const auto read = whole.render(frame.scene, frame.spec);
    ASSERT_TRUE(untold) << untold.problems()[0].detail;
    ASSERT_TRUE(read) << read.problems()[0].detail;
    expectSameViews(*untold, *read, i);
  }
}

TEST(LazyTexels, AFrameIsTheSameWhateverTexelsEarlierOnesMade) {
  // Kept tiles that earlier frames filled in part, for another camera or for the whole.
  Renderer fresh = processor(0);
  Renderer keeping = processor(std::size_t{1} << 28);
  std::mt19937 random(14);
  int reused = 0;
  for (int i = 0; i < 200; ++i) {
    auto frame = mappedFrame(random);
    if (!frame) continue;
    FrameSpec part = frame->spec;
    part.width = std::max(1, part.width / 3);
    part.height = std::max(1, part.height / 4);
    FrameSpec all = frame->spec;
    all.views.push_back(View::atlas);
    const auto expected = fresh.render(frame->scene, frame->spec);
    if (!expected || !keeping.render(frame->scene, part)) continue;
    const auto after = keeping.render(frame->scene, frame->spec);
    ASSERT_TRUE(after);
    expectSameViews(*expected, *after, i);
    if (!keeping.render(frame->scene, all)) continue;
    const auto afterAll = keeping.render(frame->scene, frame->spec);
    ASSERT_TRUE(afterAll);
    expectSameViews(*expected, *afterAll, i);
    for (const LightReport& light : afterAll->report.lights) {
      for (const TileReport& tile : light.tiles) reused += tile.reused ? 1 : 0;
    }
  }
  EXPECT_GT(reused, 100);
}

} // namespace
} // namespace gnomon
