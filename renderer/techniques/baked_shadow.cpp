#include "renderer/techniques/baked_shadow.h"

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

/// Samples that are looked up together, and where their shares go.
struct Waiting {
  ShownSamples samples;
  std::uint16_t* shares[DrawnPlaces::kCount];
};

class Lookup {
 public:
  Lookup(const PicturePoints& points, const BakedLight& baked, std::uint16_t* shares)
      : points_(points), baked_(baked), shares_(shares) {}

  /// One after the other, by squares that a packet fills.
  void rows(int first, int last) {
    const SampleGrid& grid = points_.grid();
    constexpr int kSquare = 4;
    for (int x = 0; x < grid.width; x += kSquare) {
      for (int y = first; y < last; ++y) {
        for (int column = x; column < std::min(x + kSquare, grid.width); ++column) add({column, y});
      }
    }
    flush();
  }

 private:
  void add(const glm::ivec2& pixel) {
    const SampleGrid& grid = points_.grid();
    const std::size_t number =
        static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(pixel.x);
    std::uint16_t* own = shares_ + number * grid.samples();
    for (std::uint32_t i = 0; i < grid.samples(); ++i) {
      const std::uint32_t shown = points_.numberAt(pixel, i);
      if (shown == kNoNumber) {
        own[i] = 65535;
        continue;
      }
      waiting_.shares[waiting_.samples.count] = own + i;
      waiting_.samples.add(glm::vec2(pixel) + grid.positions[i], shown);
      if (waiting_.samples.full()) flush();
    }
  }

  void flush() {
    if (waiting_.samples.count == 0) return;
    const DrawnPlaces places = points_.drawn(waiting_.samples);
    const DrawnWeights at = points_.weights(places);
    const LightMapLayout& layout = *baked_.layout;
    for (std::size_t i = 0; i < waiting_.samples.count; ++i) {
      const PlacedTriangle& triangle = places.shown[i];
      const glm::vec2* corner =
          &layout.corners[layout.firstCorner[triangle.instance] + 3 * std::size_t{triangle.triangle}];
      const glm::vec2 place = corner[0] + at.u[i] * (corner[1] - corner[0]) + at.v[i] * (corner[2] - corner[0]);
      *waiting_.shares[i] = unorm16(shareAt(baked_.map, place));
    }
    waiting_.samples.count = 0;
  }

  const PicturePoints& points_;
  const BakedLight& baked_;
  std::uint16_t* shares_;
  Waiting waiting_;
};

} // namespace

UnfilledVector<std::uint16_t> bakedShadow(const PicturePoints& points, const BakedLight& baked) {
  constexpr std::size_t kRows = 16;
  const SampleGrid& grid = points.grid();
  UnfilledVector<std::uint16_t> shares(grid.pixels() * grid.samples() + 1); // read by pairs
  forEachPiece(static_cast<std::size_t>(grid.height), kRows, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; row += 4) {
      Lookup(points, baked, shares.data()).rows(static_cast<int>(row), static_cast<int>(std::min(row + 4, last)));
    }
  });
  shares.resize(grid.pixels() * grid.samples());
  return shares;
}

} // namespace gnomon
