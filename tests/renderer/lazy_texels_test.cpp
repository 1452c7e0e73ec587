// The processor makes only those texels of a shadow map that a picture reads: the picture is the one that it would be
// had every texel of every tile been made first.
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
