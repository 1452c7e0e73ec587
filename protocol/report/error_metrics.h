#pragma once

#include <cstdint>
#include <optional>

/// Rows of the fields: metric_rows.h.
namespace gnomon {

/// How large shadow texels show in the picture: Lloyd's m over the blocks of 8 x 8 pixels that show a surface, each at
/// the nearest surface in it. m is the largest extent in pixels of the texel under a point, on a surface there that
/// faces the light (Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006); a surface that the light
/// grazes shows a larger one.
struct PredictedError {
  double median = 0;
  double p95 = 0;
  double max = 0;
  std::optional<double> edgeDisplacement{};
  std::optional<double> edgeLength{};
};

/// How far the edges of a shadow lie from the true ones.
struct EdgeDisplacement {
  double mean = 0;
  double median = 0;
  double p95 = 0;
  double max = 0;
};

/// A shadow S held against the exact share V of the light, over the receivers: pixels whose surface receives shadows,
/// faces the light and lies within its reach. Shares are of the receivers, 0..1; both S and V say "lit" from 0.5 on.
struct ErrorMetrics {
  std::uint64_t receivers = 0;
  double misclassified = 0;
  double falseShadow = 0;
  double falseLit = 0;
  // The same ones by cause; their sum is `misclassified`:
  double acne = 0;
  double leak = 0;
  double edge = 0;
  double interior = 0;
  std::optional<EdgeDisplacement> edgeDisplacement{};
  double meanAbsolute = 0;
  double rms = 0;
  std::optional<double> shimmer{};
  std::optional<PredictedError> predicted{};
};

} // namespace gnomon
