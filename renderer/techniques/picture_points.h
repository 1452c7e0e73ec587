#pragma once

#include "renderer/prepare/triangle_numbers.h"
#include "renderer/reference/trace.h"
#include "renderer/techniques/sample_grid.h"

namespace gnomon {

/// The points that a picture's samples show, for rays that go on from there. Pixels are numbered as in SampleGrid.
class PicturePoints {
 public:
  /// `shown`: the number of the triangle that each sample shows, or kNoNumber; `masks`: a byte a pixel, not 0 where
  /// masked triangles lie, empty = nowhere. All that the others refer to outlives it.
  PicturePoints(const TraceInput& rays, const SampleGrid& grid, const TriangleNumbers& numbers,
                std::vector<std::uint32_t> shown, std::vector<std::uint8_t> masks)
      : rays_(rays), grid_(grid), numbers_(numbers), shown_(std::move(shown)), masks_(std::move(masks)) {}

  const TraceInput& rays() const { return rays_; }
  const SampleGrid& grid() const { return grid_; }

  /// What each of these pixels shows at its first sample, as it was drawn: the exact point, but for samples that the
  /// rim of a surface passes within the device's rounding, and for masks, which are filtered as they are drawn.
  std::vector<SurfacePoint> drawn(std::span<const std::uint32_t> pixels) const;

  /// What a ray through each of their samples meets first.
  std::vector<SurfacePoint> traced(std::span<const std::uint32_t> pixels) const;

  /// The pixels where masked triangles lie, and those next to them or to their corners.
  std::vector<std::uint32_t> besideMasks() const;

 private:
  TraceInput rays_;
  const SampleGrid& grid_;
  const TriangleNumbers& numbers_;
  std::vector<std::uint32_t> shown_;
  std::vector<std::uint8_t> masks_;
};

} // namespace gnomon
