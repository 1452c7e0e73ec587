#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/textures.h"
#include "renderer/image/image.h"

/// A view's picture from the triangles that its samples show: everything else comes from the triangles again.
namespace gnomon::cpu {

/// Views of numbers, each of which data_view draws.
inline constexpr std::array kDataViews{View::depth,       View::normal, View::shadow,    View::texelDensity,
                                       View::blendWeight, View::bias,   View::casterIds, View::albedo};
static_assert([] {
  std::size_t found = 0;
  for (const ViewTraits& view : kViewTraits) {
    if (view.source == ViewSource::data && (found == kDataViews.size() || kDataViews[found++] != view.view))
      return false;
  }
  return found == kDataViews.size();
}());

/// What a view is made from. All of it outlives the call.
struct ShowJob {
  const FrameScene& scene;
  const Textures& textures;
  const DepthBuffer& buffer; ///< numbered; data has one sample a pixel
  const ShadowMaps& maps;
  std::span<const std::uint32_t> lightLists; ///< lightLists; empty = every light may reach every pixel
  View view = View::color;
  bool encoded = true; ///< as in ViewRequest
  bool fine = false;   ///< as in ViewRequest
  int tone = GNOMON_TONE_ACES;
  int debugLight = -1;                          ///< what views of one light show; -1 = there is none
  std::span<const TileMap> casters = {};        ///< view casterIds: parallel to the maps', numbered, a sample a texel
  std::span<const glm::vec4> volumes = {};      ///< marchPicture; empty = none are seen
  std::span<const std::int32_t> slotNodes = {}; ///< view casterIds: the node of each slot
};

/// Whether the surroundings are seen where no surface is.
inline bool showsSurroundings(const ShowJob& job) {
  const bool lit = traitsOf(job.view).source == ViewSource::picture && job.view != View::lightContribution;
  return lit && job.scene.frame.shownRoughness >= 0;
}

/// Whether all pixels that show no surface are the same.
inline bool isPlainBehind(const ShowJob& job) {
  return job.volumes.empty() && !showsSurroundings(job);
}

/// The picture, first row on top, on all cores. `opaque`: as in ViewRequest.
Image showView(const ShowJob& job, bool opaque);

/// Pixels along a side of the squares that are shown at a time.
inline constexpr int kTileSide = 16;
inline constexpr std::size_t kTilePixels = std::size_t{kTileSide} * kTileSide;

/// The colors of a square: its pixels block by block, and in each row by row from the BOTTOM; linear.
struct TileColors {
  alignas(64) std::array<std::array<float, kTilePixels>, 4> channels; ///< R, G, B, A
};

/// What pixels of a square show. `samples` of a pixel, a bit each, show this triangle.
struct FragmentList {
  static constexpr std::size_t kMost = 4 * kTilePixels;
  static constexpr std::size_t kPacket = 16; ///< read at a time; behind the last there are some more like it
  alignas(64) std::array<std::uint32_t, kMost + kPacket> triangle; ///< FrameScene's number
  alignas(64) std::array<std::int32_t, kMost + kPacket> pixel;     ///< of TileColors
  alignas(64) std::array<std::int32_t, kMost + kPacket> samples;
  std::size_t count = 0;
};

/// The column and the row of a square's pixel, from its lower left corner.
constexpr int columnOf(int pixel) {
  return (pixel >> 2 & 12) | (pixel & 3);
}
constexpr int rowOf(int pixel) {
  return (pixel >> 4 & 12) | (pixel >> 2 & 3);
}
constexpr int pixelAt(int column, int row) {
  return (row & 12) << 4 | (column & 12) << 2 | (row & 3) << 2 | (column & 3);
}

/// The fragments of the square whose lower left pixel is x, y, those of an instance one behind the other: block by
/// block, of each first what its pixels' first samples show, then what others show. Where dozens of instances show,
/// they stay mixed. `without`: the blocks that are left out, a bit each.
void listFragments(const DepthBuffer& buffer, int x, int y, FragmentList& list, unsigned without = 0);

/// The colors of a view of source `picture`: the mean of each pixel's samples.
void pictureSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

/// The numbers of a view of source `data`.
void dataSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

/// Calls `each(list, x, y)` with the fragments of every square of the picture, on all cores.
template <class Each>
void forEachSquare(const DepthBuffer& buffer, const Each& each) {
  const auto across = static_cast<std::size_t>((buffer.width + kTileSide - 1) / kTileSide);
  const auto up = static_cast<std::size_t>((buffer.height + kTileSide - 1) / kTileSide);
  forEachPiece(across * up, 8, [&](std::size_t first, std::size_t last) {
    FragmentList list;
    for (std::size_t i = first; i < last; ++i) {
      const int x = static_cast<int>(i % across) * kTileSide;
      const int y = static_cast<int>(i / across) * kTileSide;
      listFragments(buffer, x, y, list);
      each(list, x, y);
    }
  });
}

} // namespace gnomon::cpu
