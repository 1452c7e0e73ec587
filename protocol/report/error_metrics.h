#pragma once

#include <cstdint>
#include <optional>

namespace gnomon {

/// How large shadow texels show in the picture: Lloyd's m over the blocks of 8 x 8 pixels that show a surface, each at
/// the nearest surface in it. m is the largest extent in pixels of the texel under a point, on a surface there that
/// faces the light (Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006); a surface that the light
/// grazes shows a larger one.
struct PredictedError {
  double median = 0; ///< pixels
  double p95 = 0;    ///< pixels: 95 % of the blocks have no more
  double max = 0;    ///< pixels
  /// Pixels: what EdgeDisplacement::mean is expected to be, told from the shadow's own edges, the texels and the bias
  /// under them (renderer/shadow/edge_displacement.h). Absent where the shadow was not drawn as numbers or has no edge.
  std::optional<double> edgeDisplacement{};
  std::optional<double> edgeLength{}; ///< pixels: of the edges that this is the mean of
};

/// How far the edges of a shadow lie from the true ones.
struct EdgeDisplacement {
  double mean = 0;   ///< pixels: the misclassified area near true edges, divided by their length
  double median = 0; ///< pixels, from each edge pixel to the nearest true edge pixel
  double p95 = 0;    ///< pixels
  double max = 0;    ///< pixels
};

/// A shadow S held against the exact share V of the light, over the receivers: pixels whose surface receives shadows,
/// faces the light and lies within its reach. Shares are of the receivers, 0..1; both S and V say "lit" from 0.5 on.
struct ErrorMetrics {
  std::uint64_t receivers = 0; ///< pixels, over all lights that were measured
  double misclassified = 0;    ///< S and V disagree
  double falseShadow = 0;      ///< of these: shadow where light is
  double falseLit = 0;         ///< of these: light where shadow is
  // The same ones by cause; their sum is `misclassified`:
  double acne = 0;     ///< false shadow farther than 2 pixels from every edge of V: a surface shadows itself
  double leak = 0;     ///< false light farther than that, or where what hides the light is nearer than 2 pixels' width
  double edge = 0;     ///< the rest: an edge in the wrong place
  double interior = 0; ///< misclassified farther than 2 pixels from every edge of V: wrong, not merely coarse
  std::optional<EdgeDisplacement> edgeDisplacement{}; ///< absent where S or V has no edge
  double meanAbsolute = 0;                            ///< of S - V
  double rms = 0;                                     ///< of S - V
  std::optional<double> shimmer{};           ///< flips of S in 1,000 points and a frame, less those of V; along a path
  std::optional<PredictedError> predicted{}; ///< told from the plan, without a reference; absent without shadow maps
};

} // namespace gnomon
