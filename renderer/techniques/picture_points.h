#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/rect.h"
#include "renderer/prepare/draw_list.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// The samples of a picture. Pixels are counted row by row from the LOWEST row, as textures hold them; the samples of a
/// pixel lie side by side.
struct SampleGrid {
  int width = 0; ///< pixels
  int height = 0;
  std::vector<glm::vec2> positions; ///< of a pixel's samples, 0..1 from its lower left corner

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t samples() const { return positions.size(); }
  std::uint32_t numberOf(const glm::ivec2& pixel) const {
    return static_cast<std::uint32_t>(pixel.y * width + pixel.x);
  }
  glm::ivec2 pixelAt(std::uint32_t number) const {
    return {static_cast<int>(number) % width, static_cast<int>(number) / width};
  }
};

/// Where rays go through, as firstHits takes it: from the picture's upper left corner.
inline glm::vec2 placeIn(const SampleGrid& grid, std::uint32_t pixel, glm::vec2 position) {
  const auto width = static_cast<std::uint32_t>(grid.width);
  const auto x = static_cast<float>(pixel % width);
  const auto row = static_cast<float>(pixel / width);
  return {x + position.x, static_cast<float>(grid.height) - (row + position.y)};
}

/// Every sample of the given pixels, pixel by pixel.
std::vector<glm::vec2> samplesOf(const SampleGrid& grid, std::span<const std::uint32_t> pixels);

/// A share 0..1 as 16-bit textures hold it, and as 8-bit ones do.
inline std::uint16_t unorm16(float share) {
  return static_cast<std::uint16_t>(double{std::clamp(share, 0.0f, 1.0f) * 65535.0f} + 0.5);
}
inline std::uint8_t unorm8(float share) {
  return static_cast<std::uint8_t>(double{std::clamp(share, 0.0f, 1.0f) * 255.0f} + 0.5);
}

/// The number of the triangle that each sample of a picture shows, or kNoNumber, in the order that a device keeps them.
struct ShownNumbers {
  std::span<const std::uint32_t> numbers;
  std::vector<std::uint32_t> ofColumn, ofRow; ///< a pixel's first sample is number ofRow[y] + ofColumn[x]
  std::uint32_t step = 1;                     ///< from one sample of a pixel to the next

  /// Of a pixel's sample; not checked.
  std::uint32_t at(int x, int y, std::uint32_t sample = 0) const {
    return numbers.data()[ofRow.data()[y] + ofColumn.data()[x] + sample * step];
  }

  /// Whether that is `number` for all pixels from `first` to before `last` of a row.
  bool areAll(std::uint32_t number, int y, int first, int last, std::uint32_t sample = 0) const;
};

/// Samples of pixels, up to DrawnPlaces::kCount of them, and the numbers that they show.
struct ShownSamples {
  glm::ivec2 pixels[DrawnPlaces::kCount];
  std::uint32_t samples[DrawnPlaces::kCount]; ///< of those pixels
  std::uint32_t numbers[DrawnPlaces::kCount];
  std::size_t count = 0;

  void add(const glm::ivec2& pixel, std::uint32_t sample, std::uint32_t number) {
    pixels[count] = pixel;
    samples[count] = sample;
    numbers[count++] = number;
  }
  bool full() const { return count == DrawnPlaces::kCount; }
};

/// In the grid's own order: row by row, the samples of a pixel side by side.
ShownNumbers inOrder(const SampleGrid& grid, std::span<const std::uint32_t> numbers);

/// The points that a picture's samples show, for rays that go on from there. Pixels are numbered as in SampleGrid.
class PicturePoints {
 public:
  /// `masks`: as masks() gives them. All that is referred to outlives it; nothing is copied.
  PicturePoints(const TraceInput& rays, const SampleGrid& grid, const TriangleNumbers& numbers,
                const ShownNumbers& shown, std::span<const std::uint8_t> masks)
      : rays_(rays), camera_(rays), grid_(grid), numbers_(numbers), shown_(shown), masks_(masks) {}

  const TraceInput& rays() const { return rays_; }
  const SampleGrid& grid() const { return grid_; }

  /// What was drawn at one of a pixel's samples; kNoNumber = nothing.
  std::uint32_t numberAt(const glm::ivec2& pixel, std::uint32_t sample = 0) const {
    return shown_.at(pixel.x, pixel.y, sample);
  }

  /// Whether the samples of a pixel show more than one triangle, or some of them none.
  bool showsSeveral(const glm::ivec2& pixel) const;

  /// What all first samples of a block show, where that is one number. REQUIRES: the block lies in the picture.
  std::optional<std::uint32_t> onlyNumberIn(const Rect& block) const;

  /// The same of all samples.
  std::optional<std::uint32_t> onlyNumberOfSamplesIn(const Rect& block) const;

  /// The block as rays know it. `number`: of the triangle that it shows alone.
  DrawnBlock drawnBlock(const Rect& block, std::uint32_t number) const;

  /// The triangle of a number. REQUIRES: one that is shown.
  PlacedTriangle placed(std::uint32_t number) const {
    PlacedTriangle triangle;
    numbers_.of({&number, 1}, {&triangle, 1});
    return triangle;
  }

  /// What these show, as it was drawn: the exact points are there, but for samples that the rim of a surface passes
  /// within the device's rounding, and for masks where alpha is as good as the cutoff.
  DrawnPlaces drawn(const ShownSamples& shown) const;

  /// Where these lie in their triangles.
  DrawnWeights weights(const DrawnPlaces& places) const { return camera_.weights(places); }

  /// What these show.
  DrawnSurfaces surfaces(const DrawnPlaces& places) const { return camera_.surfaces(places); }

  /// What a ray through each of their samples meets first. Runs on the calling thread.
  std::vector<SurfacePoint> traced(std::span<const std::uint32_t> pixels) const;

  /// A byte a pixel, not 0 where masked triangles lie; empty = nowhere.
  std::span<const std::uint8_t> masks() const { return masks_; }

  /// The pixels where masked triangles lie, and those next to them or to their corners.
  std::vector<std::uint32_t> besideMasks() const;

 private:
  TraceInput rays_;
  TracedCamera camera_;
  const SampleGrid& grid_;
  const TriangleNumbers& numbers_;
  const ShownNumbers& shown_;
  std::span<const std::uint8_t> masks_;
};

} // namespace gnomon
