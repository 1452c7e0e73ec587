#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/core/rect.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/filter_kernel.h"
#include "renderer/shadow/tile_space.h"

namespace gnomon {

/// The nearest and farthest surface, as view depth in metres.
struct DepthSpan {
  float nearest = 0;
  float farthest = -1; ///< less than nearest = no surface
  bool open = true;    ///< some sample shows no surface
  bool empty() const { return farthest < nearest; }
};

/// Pixels along a side of the blocks that a survey is reduced to.
inline constexpr int kSurveyBlock = 8;

/// What the camera sees, reduced: a span for each square block of pixels, row by row from the TOP of the picture.
/// The spans hold every sample of every pixel that shows a surface.
struct ReceiverDepths {
  int blockSize = kSurveyBlock; ///< pixels
  int width = 0;                ///< of the frame, pixels
  int height = 0;
  int columns = 0; ///< ceil(width / blockSize)
  int rows = 0;
  std::vector<DepthSpan> blocks;
  DepthSpan range; ///< over all blocks; empty = nothing in view
};

/// What the camera sees of all surfaces, and of parts of them.
struct SeenDepths {
  ReceiverDepths all;
  std::vector<ReceiverDepths> parts;
};

/// A light that asks for a shadow.
struct ShadowCaster {
  int light = 0;                  ///< index into the effective spec's lights
  glm::dvec3 direction{0, -1, 0}; ///< where the light travels; unit length; directional and spot
  Shadow shadow;                  ///< an absent size is Large
  LightType type = LightType::directional;
  glm::dvec3 position{0};       ///< relative to the eye; spot and point
  double range = 0;             ///< metres; spot and point; 0 = no end
  double outerCone = 0;         ///< half angle, radians, less than a quarter turn; spot
  double lightRadius = 0;       ///< of the light itself, see radiusOf in renderer/core/light.h
  bool casts = true;            ///< something of its layers casts shadows
  bool shadows = true;          ///< something of its layers that the camera may see receives them
  int part = -1;                ///< of what is seen, which it casts shadows on: index into SeenDepths::parts; -1 = all
  std::optional<Aabb> bounds{}; ///< in the world: of what casts or receives its shadows; absent = the scene's
};

struct PlanInput {
  CameraView view;
  ReceiverDepths receivers;          ///< all that the camera sees
  std::vector<ReceiverDepths> parts; ///< as SeenDepths has them
  Aabb sceneBounds;                  ///< of all that casts or receives, in the world
  glm::dvec3 anchor{0};              ///< in the world: casters are placed by it, whatever the camera
  std::vector<ShadowCaster> casters;
  Atlas atlas;
  int maxTextureSize = 16384; ///< of the device
  int frameWidth = 0;         ///< pixels
  int frameHeight = 0;
};

/// What the camera sees of the surfaces on which a light casts its shadows. Nothing else decides about them.
inline const ReceiverDepths& receiversOf(const PlanInput& input, const ShadowCaster& caster) {
  return caster.part < 0 ? input.receivers : input.parts[static_cast<std::size_t>(caster.part)];
}

/// One cascade, or one face of a spot or point light: a rectangle of the atlas with its own matrix.
struct ShadowTile {
  /// Cascade: the view depths in which pixels use it (the blend zone included). Face: where its receivers lie, by their
  /// distance from the light along the tile's direction.
  double near = 0;
  double far = 0;
  double blendNear = 0; ///< cascade: where blending to the next (or fading out) begins; = far where there is none
  Rect rect;            ///< in the atlas, border included; width 0 = no surface in view lies in it, not drawn
  int border = 0;       ///< texels kept on each side, so that no filter leaves the rectangle
  FilterKernel filter;  ///< of its light
  TileSpace space;
  glm::dmat4 clipFromRelative{1}; ///< of the space
  glm::dmat4 clipFromAnchored{1}; ///< the same from positions relative to the plan's anchor
  /// Added towards the light in z units: depthBias + depthBiasNear / w^2 covers the depth quantum and rounding.
  double depthBias = 0;
  double depthBiasNear = 0; ///< 0 for parallel light, whose w is 1
  ReceiverMask receivers;   ///< what the tile serves
};

/// True for a tile that has texels and whose filter reads moments.
inline bool isBlurred(const ShadowTile& tile) {
  return tile.rect.width > 0 && tile.filter.moments;
}

/// Why a light that casts shadows on what is in view has no tiles for them.
enum class NoTexels { none, atlasFull, outOfRange };

struct PlannedLight {
  int light = 0;
  int firstTile = 0; ///< into ShadowPlan::tiles
  int tileCount = 0; ///< cascades or faces, drawn or not; 0 = no shadow is drawn; `note` says why
  int askedTileSize = 0;
  int grantedTileSize = 0;
  /// The last tile fades to lit over its blend zone: surfaces may lie beyond it (manual depth range, or manual splits
  /// that end before the range does).
  bool fadeOut = false;
  std::optional<DepthInterval> depthRange{}; ///< directional: the base of its depth range, see PlannedRange
  NoTexels noTexels = NoTexels::none;
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

} // namespace gnomon
