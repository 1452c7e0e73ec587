#pragma once

#include <span>
#include <vector>

#include "protocol/spec/shadow_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/core/rect.h"
#include "renderer/shadow/fit.h"
#include "renderer/shadow/shadow_plan.h"

/// Texels: how many a light asks for, how many it gets, and where in the atlas its tiles lie.
namespace gnomon {

/// Texels to which a smaller tile is raised, with a note in the plan: wide enough for every kernel and snapping step.
inline constexpr int kSmallestTile = 64;

/// The smallest sphere around all that a spot or point light reaches, relative to the eye. REQUIRES: it has a range.
Sphere reachOf(const ShadowCaster& light);

/// How large a light shows in the picture, pixels, rounded up: the diameter of the circle around the picture of the
/// sphere that it reaches, 0 where that is out of view; at most the larger side of the frame, which it is for a light
/// without an end and where the camera is within its reach.
int lightSize(const ShadowCaster& light, const CameraView& view, int frameWidth, int frameHeight);

/// Tiles of one light: all of them or none get into the atlas.
struct TileRequest {
  int light = 0; ///< stable name of the light; a lower one is kept in preference to a higher
  int tileCount = 0;
  int size = 0; ///< texels along a side, a power of two
  ShadowImportance importance = ShadowImportance::high;
};

/// The size that each request gets so that all fit into a square of `atlasSide` texels (a power of two); 0 = refused.
/// While they don't fit, a request of the least importance that can shrink is halved: of those the one with the largest
/// tiles, of equals the one with the highest light. Where even tiles of kSmallestTile don't fit, the highest light of
/// the least importance is refused and the others start again. What is left over goes back to the halved ones.
std::vector<int> grantTileSizes(std::span<const TileRequest> requests, int atlasSide);

/// One square to place.
struct TileSquare {
  int light = 0;
  int cascade = 0;
  int size = 0; ///< texels, a power of two
};

struct AtlasLayout {
  int width = 0; ///< texels, powers of two: the least area that holds the squares; 0 without any
  int height = 0;
  std::vector<Rect> rects; ///< in the order of the squares
};

/// Places squares whose sides are powers of two, without waste: sorted by size, light and cascade, along a Z-order
/// curve (Morton, 1966), on which a square of s x s texels is any aligned run of s^2.
AtlasLayout packSquares(std::span<const TileSquare> squares);

} // namespace gnomon
