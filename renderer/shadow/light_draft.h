#pragma once

#include <vector>

#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/tile_space.h"

namespace gnomon {

/// A pyramid of directions around a light that one tile can hold.
struct LightFace {
  LightBasis basis;
  double tanHalf = 1; ///< of the half angle to each side
};

/// The faces of a spot or point light: one for a spot that one tile can hold; for a wider spot those faces of a cube
/// turned along it that its cone touches; all six of a cube along the world's axes for a point light.
std::vector<LightFace> facesOf(const ShadowCaster& light);

/// One tile before its size is known.
struct TileDraft {
  LightBasis basis;
  glm::dvec3 origin{0};        ///< of light space, relative to the eye
  CascadeInterval cascade;     ///< parallel light: the depths that it serves
  double tanHalf = 0;          ///< light from a point: how far to each side the tile may reach
  std::vector<Aabb> receivers; ///< what the camera sees in it, as boxes in light space; none = it is not drawn
};

/// What is decided about a light before the atlas is shared out.
struct LightDraft {
  bool stable = false;          ///< fitted to the light and the lens alone: the same however the camera moves
  std::vector<TileDraft> tiles; ///< empty = no shadow is drawn
  PlannedLight planned;
};

/// The origin of light space relative to the plan's anchor, free of the rounding that the eye's place brings: equal
/// lights have equal origins, to the bit, whatever camera sees them.
glm::dvec3 anchoredOrigin(const PlanInput& input, const TileDraft& tile);

/// What takes part in a light's shadows, relative to the anchor.
Aabb anchoredBounds(const PlanInput& input, const ShadowCaster& caster);

void addNote(PlannedLight& light, const std::string& note);

/// A directional light's cascades; `draft.planned` gets the notes.
void draftCascades(const ShadowCaster& caster, const PlanInput& input, LightDraft& draft);

/// What the camera sees, relative to the eye.
struct SeenSurfaces {
  std::vector<Aabb> pieces;        ///< boxes along the world's axes that together hold it
  std::vector<glm::dvec3> samples; ///< some points of it
};

/// A spot or point light's faces. A spot's only one is turned so that what is seen fills it. Where the light's shadow
/// is to be stabilized, faces are not turned, and each serves all of its pyramid and not what is seen alone.
void draftFaces(const ShadowCaster& caster, const PlanInput& input, const SeenSurfaces& seen, LightDraft& draft);

} // namespace gnomon
