#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/light_draft.h"
#include "renderer/shadow/receiver_pieces.h"
#include "renderer/shadow/tight_roll.h"

namespace gnomon {
namespace {

void noteEmptyCascades(LightDraft& draft) {
  std::string indices;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < draft.tiles.size(); ++i) {
    if (!draft.tiles[i].receivers.empty()) {
      ++drawn;
      continue;
    }
    indices += (indices.empty() ? "" : ", ") + std::to_string(i);
  }
  if (drawn == 0) {
    draft.tiles.clear();
    addNote(draft.planned, "nothing in view within the depth range");
  } else if (!indices.empty()) {
    addNote(draft.planned, "not drawn, for nothing in view lies in them: cascades " + indices);
  }
}

} // namespace

void draftCascades(const ShadowCaster& caster, const PlanInput& input, LightDraft& draft) {
  const Shadow& shadow = caster.shadow;
  const bool manual = shadow.depthRange.mode == DepthRangeMode::manual;
  const PlannedRange planned = *depthRangeOf(input.view, input.receivers, shadow.depthRange);
  const DepthInterval& range = planned.covered;
  draft.planned.depthRange = planned.base;
  const std::vector<double> splits = splitDistances(shadow.partition, shadow.cascadeCount, range);
  draft.planned.fadeOut = manual || splits.back() < range.far;
  const bool held = manual || shadow.depthRange.previous.has_value(); // not this frame's alone
  draft.stable = held && shadow.stabilization != Stabilization::none;
  const LightBasis basis = lightBasis(caster.direction);
  for (const CascadeInterval& cascade : cascadeIntervals(splits, shadow.blendCascades, draft.planned.fadeOut)) {
    TileDraft tile;
    tile.cascade = cascade;
    tile.basis = draft.stable ? basis : tightBasis(input.view, input.receivers, basis, cascade);
    tile.origin = input.anchor - input.view.eye;
    tile.receivers = receiverPieces(input.view, input.receivers, tile.basis, cascade);
    const glm::dvec3 fromOrigin = tile.basis.lightFromWorld() * -tile.origin;
    for (Aabb& piece : tile.receivers) piece = {piece.min + fromOrigin, piece.max + fromOrigin};
    draft.tiles.push_back(std::move(tile));
  }
  if (shadow.stabilization != Stabilization::none && !draft.stable) {
    addNote(draft.planned, "stabilization is ignored: the depth range is automatic");
  }
  if (!planned.note.empty()) addNote(draft.planned, planned.note);
  noteEmptyCascades(draft);
}

} // namespace gnomon
