#pragma once

#include <vector>

#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/splits.h"

namespace gnomon {

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
  bool stable = false;
  std::vector<TileDraft> tiles; ///< empty = no shadow is drawn
  PlannedLight planned;
};

void addNote(PlannedLight& light, const std::string& note);

/// A directional light's cascades; `draft.planned` gets the notes.
void draftCascades(const ShadowCaster& caster, const PlanInput& input, LightDraft& draft);

/// A spot or point light's faces. `pieces`: what the camera sees, as boxes along the world's axes, relative to the eye.
void draftFaces(const ShadowCaster& caster, const std::vector<Aabb>& pieces, LightDraft& draft);

} // namespace gnomon
