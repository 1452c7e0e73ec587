#include <atomic>
#include <bit>
#include <set>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/raster/mesh.h"

namespace gnomon::cpu {
namespace {

constexpr int kWidth = 131, kHeight = 70;

/// Whether a triangle fills a pixel: no pattern that lanes, blocks or squares have, too.
bool fills(std::uint32_t number, bool counterClockwise, int x, int y) {
  std::uint32_t hash =
      (2 * number + (counterClockwise ? 1u : 0u)) * 0x9e3779b9u ^ static_cast<std::uint32_t>(x * 131 + y) * 0x85ebca6bu;
  hash ^= hash >> 15;
  return (hash * 0xc2b2ae35u >> 28 & 1u) != 0;
}

class AnyHoles : public Holes {
 public:
  explicit AnyHoles(const Mesh& mesh) : mesh_(mesh) {}

  unsigned filled(const HoledPlaces& places, unsigned asked) const override {
    unsigned filled = 0;
    for (unsigned left = asked; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      others_ += mesh_.slots[places.number[i] / kClusterTriangles].instance != places.instance ? 1 : 0;
      if (fills(places.number[i], (places.counterClockwise >> i & 1u) != 0, places.x[i], places.y[i]))
        filled |= 1u << i;
    }
    ++calls_;
    asked_ += std::popcount(asked);
    return filled;
  }

  int others() const { return others_; }
  double placesACall() const { return static_cast<double>(asked_) / std::max(1, calls_.load()); }

 private:
  const Mesh& mesh_;
  mutable std::atomic<int> others_ = 0, calls_ = 0, asked_ = 0;
};

/// Three nets over each other, a few triangles of each by turns, those of one turn of one instance. The first and the
/// last net lie at one depth, and the last alone has no holes.
Mesh layers(Random& random, int cells, double reach) {
  constexpr std::uint32_t kTurn = 8; // triangles
  Mesh mesh;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  for (int layer = 0; layer < 3; ++layer) {
    const Mesh one = net(random, cells, reach);
    const auto base = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : one.scene.positions) positions.emplace_back(p.x, p.y, layer == 1 ? 0.5f : 0.25f);
    for (const std::uint32_t index : one.scene.welded) indices.push_back(base + index);
  }
  const auto each = static_cast<std::uint32_t>(indices.size() / 9);
  for (std::uint32_t turn = 0; turn < each / kTurn; ++turn) {
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      mesh.draws.push_back({static_cast<std::uint32_t>(mesh.slots.size()), Facing::both, layer != 2});
      mesh.slots.push_back({turn, 3 * (layer * each + turn * kTurn), kTurn, 0, 0});
    }
  }
  mesh.scene.positions = std::move(positions);
  mesh.scene.welded = std::move(indices);
  return mesh;
}

/// What comes of drawing one triangle after the other.
DepthBuffer oneByOne(const Mesh& mesh, int samples, DepthRange range) {
  DepthBuffer all = drawn(meshOf(mesh.scene.positions, {}), kWidth, kHeight, samples, range);
  for (const RasterDraw& draw : mesh.draws) {
    const Slot& slot = mesh.slots[draw.slot];
    for (std::uint32_t t = 0; t < slot.triangles; ++t) {
      const std::uint32_t* own = &mesh.scene.welded[slot.firstIndex + 3 * std::size_t{t}];
      const DepthBuffer one =
          drawn(meshOf(mesh.scene.positions, {own[0], own[1], own[2]}), kWidth, kHeight, samples, range);
      const glm::vec3 a = mesh.scene.positions[own[0]];
      const bool counterClockwise =
          glm::cross(mesh.scene.positions[own[1]] - a, mesh.scene.positions[own[2]] - a).z > 0;
      const std::uint32_t number = draw.slot * kClusterTriangles + t;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          if (draw.holed && !fills(number, counterClockwise, x, y)) continue;
          for (int s = 0; s < samples; ++s) {
            const std::size_t at = one.at(x, y, s);
            if (one.triangles[at] != 0) continue;
            const bool nearer =
                range == DepthRange::reversed ? one.depths[at] > all.depths[at] : one.depths[at] < all.depths[at];
            if (!nearer) continue;
            all.depths[at] = one.depths[at];
            all.triangles[at] = number;
          }
        }
      }
    }
  }
  return all;
}

int differing(const DepthBuffer& a, const DepthBuffer& b, bool numbers) {
  int count = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int s = 0; s < a.samples; ++s) {
        const std::size_t at = a.at(x, y, s);
        count += a.depths[at] != b.depths[at] || (numbers && a.triangles[at] != b.triangles[at]) ? 1 : 0;
      }
    }
  }
  return count;
}

TEST(HoledTriangles, AreAsIfDrawnOneByOne) {
  Random random(5);
  const std::vector<Mesh> meshes{layers(random, 9, 1.1), layers(random, 2, 30.0)};
  for (const Mesh& mesh : meshes) {
    const std::vector<glm::mat4> clip(mesh.slots.size(), glm::mat4(1));
    for (const int samples : {1, 4}) {
      for (const DepthRange range : {DepthRange::reversed, DepthRange::clamped}) {
        const DepthBuffer expected = oneByOne(mesh, samples, range);
        EXPECT_GT(std::set(expected.triangles.begin(), expected.triangles.end()).size(), 2u);
        onEachInstructionSet([&] {
          for (const bool numbered : {true, false}) {
            const AnyHoles holes(mesh);
            RasterInput input{mesh.scene, mesh.slots, clip, mesh.draws, &holes};
            input.fresh = true;
            DepthBuffer buffer = unfilledBuffer(kWidth, kHeight, samples, numbered);
            RasterScratch scratch;
            raster(input, range, buffer, scratch);
            EXPECT_EQ(differing(expected, buffer, numbered), 0);
            EXPECT_EQ(holes.others(), 0);
            EXPECT_GT(holes.placesACall(), 10);
          }
        });
      }
    }
  }
}

/// Leaves out every other pixel.
class Chequers : public Holes {
 public:
  unsigned filled(const HoledPlaces& places, unsigned asked) const override {
    unsigned filled = 0;
    for (unsigned left = asked; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      if ((places.x[i] + places.y[i]) % 2 != 0) filled |= 1u << i;
    }
    asked_ += std::popcount(asked);
    return filled;
  }

  int asked() const { return asked_; }

 private:
  mutable std::atomic<int> asked_ = 0;
};

TEST(HoledTriangles, ShowWhatLiesBehind) {
  const std::vector<glm::vec3> positions{{-3, -1, 0.9f}, {3, -1, 0.9f}, {0, 4, 0.9f},
                                         {-3, -1, 0.5f}, {3, -1, 0.5f}, {0, 4, 0.5f}};
  Mesh mesh = meshOf(positions, {0, 1, 2});
  mesh.scene.welded = {0, 1, 2, 3, 4, 5};
  mesh.slots.push_back({0, 3, 1, 0, 0});
  mesh.draws.front().holed = true;
  mesh.draws.push_back({1, Facing::both, false});
  for (const int samples : {1, 4}) {
    const Chequers chequers;
    RasterInput input = mesh.input();
    input.holes = &chequers;
    input.fresh = true;
    DepthBuffer buffer = unfilledBuffer(16, 16, samples, true);
    RasterScratch scratch;
    EXPECT_EQ(raster(input, DepthRange::reversed, buffer, scratch), 2u);
    for (int s = 0; s < samples; ++s) {
      EXPECT_EQ(buffer.triangles[buffer.at(9, 8, s)], 0u);
      EXPECT_EQ(buffer.triangles[buffer.at(8, 8, s)], kClusterTriangles);
    }
    EXPECT_LE(chequers.asked(), 16 * 16) << "once for all samples of a pixel";
    EXPECT_GT(chequers.asked(), 16 * 16 / 2);
  }
}

} // namespace
} // namespace gnomon::cpu
