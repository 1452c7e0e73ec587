#include <algorithm>
#include <cmath>

#include "renderer/shadow/light_draft.h"
#include "renderer/shadow/light_faces.h"

namespace gnomon {
namespace {

/// True where a part of the box (light space) lies in the face's pyramid.
bool mayLieIn(const Aabb& box, double tanHalf) {
  const double reach = tanHalf * box.max.z;
  return box.max.z > 0 && box.min.x <= reach && box.max.x >= -reach && box.min.y <= reach && box.max.y >= -reach;
}

/// All that a face can serve: its pyramid as far as the light or the scene reaches, whatever the camera sees of it.
Aabb wholeFace(const ShadowCaster& caster, const PlanInput& input, const TileDraft& tile) {
  constexpr double kRoom = 2; // surfaces are seen as boxes, which reach beyond the scene
  const Aabb scene{input.sceneBounds.min - input.anchor, input.sceneBounds.max - input.anchor};
  double far = kRoom * transformed(lightFromRelative(tile.basis, anchoredOrigin(input, tile)), scene).max.z;
  for (const Aabb& piece : tile.receivers) far = std::max(far, piece.max.z);
  if (caster.range > 0) far = std::min(caster.range, far);
  const double side = tile.tanHalf * far;
  return {glm::dvec3(-side, -side, 0), glm::dvec3(side, side, far)};
}

} // namespace

void draftFaces(const ShadowCaster& caster, const PlanInput& input, const std::vector<Aabb>& pieces,
                LightDraft& draft) {
  draft.stable = caster.shadow.stabilization != Stabilization::none;
  std::vector<Aabb> reached;
  const double range = caster.range > 0 ? caster.range : HUGE_VAL;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(reached),
               [&](const Aabb& piece) { return squaredDistance(piece, caster.position) <= range * range; });
  for (const LightFace& face : facesOf(caster)) {
    TileDraft tile;
    tile.basis = face.basis;
    tile.origin = caster.position;
    tile.tanHalf = face.tanHalf;
    const glm::dmat4 toLightSpace = lightFromRelative(face.basis, caster.position);
    for (const Aabb& piece : reached) {
      Aabb box = transformed(toLightSpace, piece);
      if (!mayLieIn(box, face.tanHalf)) continue;
      box.max.z = std::min(box.max.z, range);
      box.min.z = std::min(box.min.z, box.max.z);
      tile.receivers.push_back(box);
    }
    if (draft.stable && !tile.receivers.empty()) tile.receivers = {wholeFace(caster, input, tile)};
    draft.tiles.push_back(std::move(tile));
  }
  const bool any = std::any_of(draft.tiles.begin(), draft.tiles.end(),
                               [](const TileDraft& tile) { return !tile.receivers.empty(); });
  if (any) return;
  draft.tiles.clear();
  addNote(draft.planned, "it reaches nothing in view");
}

} // namespace gnomon
