#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/reference/reference.h"

namespace gnomon::bench {

/// What another renderer drew, a value a pixel, the first row on top.
struct OtherPicture {
  std::vector<float> shown; ///< S: its light with shadows, divided by that without
  std::vector<float> depth; ///< view depth of its surface, metres; 0 = none
};

/// Reads little-endian floats, S and depth in turn, row by row; nothing where the file has another size.
std::optional<OtherPicture> readOtherPicture(const std::filesystem::path& file, std::size_t pixels);

/// Whether both renderers look through one camera at one scene.
struct Alignment {
  std::vector<std::uint8_t> same{}; ///< one a pixel: 1 = no surface in either, or the same one
  double coverage = 0;              ///< share of the pixels at which just one of them shows a surface
  double surface = 0;               ///< share at which both do, but not the same one
  double offset = 0; ///< widths of a pixel, the median: how far the other's points lie off the reference's surfaces
};

/// The other's surface is the reference's where its point on the pixel's ray lies within half the pixel's width of the
/// plane through the reference's. `anchor`: what the reference's positions are relative to.
Alignment alignmentOf(const Reference& truth, const CameraView& view, const glm::dvec3& anchor,
                      std::span<const float> depth);

} // namespace gnomon::bench
