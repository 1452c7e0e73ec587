#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocol/shadow_options.h"
#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/core/rect.h"
#include "renderer/shadow/receiver_mask.h"

namespace gnomon {

/// The nearest and farthest surface, as view depth in metres.
struct DepthSpan {
  float nearest = 0;
  float farthest = -1; ///< less than nearest = no surface
  bool open = true;    ///< some sample shows no surface
  bool empty() const { return farthest < nearest; }
};

/// What the camera sees, reduced: a span for each square block of pixels, row by row from the TOP of the picture.
/// The spans hold every sample of every pixel that shows a surface.
struct ReceiverDepths {
  int blockSize = 8; ///< pixels
  int width = 0;     ///< of the frame, pixels
  int height = 0;
  int columns = 0; ///< ceil(width / blockSize)
  int rows = 0;
  std::vector<DepthSpan> blocks;
  DepthSpan range; ///< over all blocks; empty = nothing in view
};

/// A light that asks for a shadow.
struct DirectionalCaster {
  int light = 0;                  ///< index into the effective spec's lights
  glm::dvec3 direction{0, -1, 0}; ///< where the light travels; unit length
  Shadow shadow;
};

struct PlanInput {
  CameraView view;
  ReceiverDepths receivers;
  Aabb sceneBounds; ///< of all casters, in the world
  std::vector<DirectionalCaster> casters;
  Atlas atlas;
  int maxTextureSize = 16384; ///< of the device
  int frameWidth = 0;         ///< pixels
  int frameHeight = 0;
};

/// One cascade: a rectangle of the atlas with its own matrix.
struct ShadowTile {
  double near = 0;      ///< view depth from which pixels use it (the blend zone included)
  double far = 0;       ///< view depth up to which pixels use it
  double blendNear = 0; ///< where blending to the next cascade (or fading out) begins; = far where there is none
  Rect rect;            ///< in the atlas, border included; width 0 = no surface in view lies in it, not drawn
  int border = 0;       ///< texels kept on each side, so that no filter leaves the rectangle
  /// Light clip space from eye-relative world space: x y in -1..1 over the whole rectangle, border included;
  /// z 0 nearest the light, 1 farthest. Affine.
  glm::dmat4 clipFromRelative{1};
  glm::dvec2 texelSize{0}; ///< metres across and along
  double depthExtent = 0;  ///< metres from z 0 to z 1
  /// Metres to move a receiver along its normal, times the sine of the angle between normal and light (see bias.h).
  double normalOffset = 0;
  /// Added towards the light in z units: covers the depth quantum.
  double depthBias = 0;
  ReceiverMask receivers; ///< what the tile serves
};

struct PlannedLight {
  int light = 0;
  int firstTile = 0; ///< into ShadowPlan::tiles
  int tileCount = 0; ///< cascades, drawn or not; 0 = no shadow is drawn; `note` says why
  int askedTileSize = 0;
  int grantedTileSize = 0;
  /// The last tile fades to lit over its blend zone: surfaces may lie beyond it (manual depth range, or manual splits
  /// that end before the range does).
  bool fadeOut = false;
  std::string note;
};

struct ShadowPlan {
  int atlasWidth = 0; ///< texels; 0 = no atlas is needed
  int atlasHeight = 0;
  std::vector<ShadowTile> tiles;
  std::vector<PlannedLight> lights; ///< one per caster of the input, same order
};

/// Decides everything about a frame's shadows before any is drawn. Pure. The input has been validated.
ShadowPlan planShadows(const PlanInput& input);

/// True where something inside `casterBounds` (eye-relative) can throw a shadow onto what `tile` serves:
/// seen along the light it overlaps a part of the tile where receivers look, and does not lie behind all of them there.
bool mayCastInto(const ShadowTile& tile, const Aabb& casterBounds);

} // namespace gnomon
