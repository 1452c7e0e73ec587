#include "renderer/shadow/shadow_plan.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <optional>

#include "renderer/shadow/atlas_packer.h"
#include "renderer/shadow/bias.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/fit.h"
#include "renderer/shadow/light_basis.h"
#include "renderer/shadow/receiver_mask.h"
#include "renderer/shadow/receiver_pieces.h"
#include "renderer/shadow/slice.h"
#include "renderer/shadow/splits.h"
#include "renderer/shadow/tight_roll.h"
#include "renderer/shadow/tile_size.h"

namespace gnomon {
namespace {

/// What is decided about a light before the atlas is shared out.
struct LightDraft {
  bool stable = false;
  std::vector<CascadeInterval> cascades; ///< empty = no shadow is drawn
  std::vector<LightBasis> bases;         ///< by cascade
  /// By cascade, in its basis: what is in view, as pieces and as the box around them; empty where nothing is.
  std::vector<std::vector<Aabb>> pieces;
  std::vector<Aabb> receiversLs;
  PlannedLight planned;
};

void addNote(PlannedLight& light, const std::string& note) {
  if (!light.note.empty()) light.note += "; ";
  light.note += note;
}

std::string texels(int size) {
  return std::to_string(size) + " x " + std::to_string(size) + " texels";
}

/// Why no shadow of this light needs to be drawn; nothing where one may.
std::optional<std::string> reasonToSkip(const DirectionalCaster& caster, const PlanInput& input) {
  if (!caster.shadow.enabled) return "the light's shadow is switched off";
  if (caster.shadow.strength <= 0) return "the shadow's strength is 0";
  if (input.receivers.range.empty()) return "nothing in view";
  if (input.sceneBounds.empty()) return "nothing in the scene casts a shadow";
  return std::nullopt;
}

void noteEmptyCascades(LightDraft& draft) {
  std::string indices;
  int drawn = 0;
  for (std::size_t i = 0; i < draft.receiversLs.size(); ++i) {
    if (!draft.receiversLs[i].empty()) {
      ++drawn;
      continue;
    }
    indices += (indices.empty() ? "" : ", ") + std::to_string(i);
  }
  if (drawn == 0) {
    draft.cascades.clear();
    addNote(draft.planned, "nothing in view within the depth range");
  } else if (!indices.empty()) {
    addNote(draft.planned, "not drawn, for nothing in view lies in them: cascades " + indices);
  }
}

LightDraft draftLight(const DirectionalCaster& caster, const PlanInput& input) {
  LightDraft draft;
  draft.planned.light = caster.light;
  if (caster.shadow.enabled && caster.shadow.strength > 0) {
    draft.planned.askedTileSize =
        askedTileSize(caster.shadow.size, input.atlas.baseSize, input.frameWidth, input.frameHeight);
  }
  if (const auto reason = reasonToSkip(caster, input)) {
    draft.planned.note = *reason;
    return draft;
  }

  const Shadow& shadow = caster.shadow;
  const bool manual = shadow.depthRange.mode == DepthRangeMode::manual;
  const DepthInterval range = *depthRangeOf(input.view, input.receivers, shadow.depthRange);
  const std::vector<double> splits = splitDistances(shadow.partition, shadow.cascadeCount, range);
  draft.planned.fadeOut = manual || splits.back() < range.far;
  draft.cascades = cascadeIntervals(splits, shadow.blendCascades, draft.planned.fadeOut);
  draft.stable = manual && shadow.stabilization != Stabilization::none;
  const LightBasis basis = lightBasis(caster.direction);
  for (const CascadeInterval& cascade : draft.cascades) {
    draft.bases.push_back(draft.stable ? basis : tightBasis(input.view, input.receivers, basis, cascade));
    draft.pieces.push_back(receiverPieces(input.view, input.receivers, draft.bases.back(), cascade));
    draft.receiversLs.push_back(boxAround(draft.pieces.back()));
  }
  if (shadow.stabilization != Stabilization::none && !draft.stable) {
    addNote(draft.planned, "stabilization is ignored: the depth range is automatic");
  }
  noteEmptyCascades(draft);
  return draft;
}

int drawnCascades(const LightDraft& draft) {
  if (draft.cascades.empty()) return 0;
  return static_cast<int>(
      std::count_if(draft.receiversLs.begin(), draft.receiversLs.end(), [](const Aabb& box) { return !box.empty(); }));
}

/// Decides the tile size of every light; a light that is refused loses its cascades.
void shareAtlas(std::vector<LightDraft>& drafts, const PlanInput& input) {
  const int side = static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::max(0, std::min(input.atlas.size, input.maxTextureSize)))));
  std::vector<TileRequest> requests;
  for (const LightDraft& draft : drafts) {
    requests.push_back(
        {draft.planned.light, drawnCascades(draft), std::max(draft.planned.askedTileSize, kSmallestTile)});
  }
  const std::vector<int> sizes = grantTileSizes(requests, side);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    LightDraft& draft = drafts[i];
    if (draft.cascades.empty()) continue;
    PlannedLight& planned = draft.planned;
    planned.grantedTileSize = sizes[i];
    if (sizes[i] == 0) {
      draft.cascades.clear();
      addNote(planned, "no room in the atlas of " + texels(side));
    } else if (sizes[i] < planned.askedTileSize) {
      addNote(planned, "tiles of " + texels(sizes[i]) + " instead of " + texels(planned.askedTileSize) +
                           ": the atlas of " + texels(side) + " is full");
    } else if (sizes[i] > planned.askedTileSize) {
      addNote(planned, "tiles of " + texels(sizes[i]) + " instead of " + texels(planned.askedTileSize) +
                           ": the least that a filter can use");
    }
  }
}

/// What the filter reads around the receivers in each piece, once they are moved along their normals.
ReceiverMask maskOf(const std::vector<Aabb>& pieces, const Fit& fit, const FitTarget& target) {
  const glm::dvec3 lowest(fit.lowest, fit.depthNear);
  const glm::dvec3 scale(2.0 / (fit.texelSize * static_cast<double>(target.tileSize)), 1.0 / fit.depthExtent);
  const glm::dvec3 origin(-1.0, -1.0, 0.0);
  std::vector<Aabb> clip;
  clip.reserve(pieces.size());
  for (const Aabb& piece : pieces) {
    Aabb box{origin + (piece.min - lowest) * scale, origin + (piece.max - lowest) * scale};
    box.max.z += 2.0 * depthBias(target.magnitude, fit.depthExtent);
    clip.push_back(box);
  }
  const glm::dvec2 reach = fit.texelSize * static_cast<double>(target.kernel.border) + fit.normalOffset;
  return receiverMask(clip, reach * glm::dvec2(scale));
}

ShadowTile planTile(const LightDraft& draft, std::size_t cascade, const DirectionalCaster& caster,
                    const PlanInput& input) {
  const CascadeInterval& interval = draft.cascades[cascade];
  ShadowTile tile;
  tile.near = interval.near;
  tile.far = interval.far;
  tile.blendNear = interval.blendNear;
  if (draft.receiversLs[cascade].empty()) return tile;

  const DepthInterval depths{interval.near - depthSlack(input.view, interval.near),
                             interval.far + depthSlack(input.view, interval.far)};
  FitTarget target;
  target.tileSize = draft.planned.grantedTileSize;
  target.kernel = kernelOf(caster.shadow.filter);
  // No term of these moves with the camera, so that a stable fit keeps its extents.
  target.reach = sliceReach(input.view, depths);
  target.magnitude = target.reach + glm::length(input.sceneBounds.max - input.sceneBounds.min);

  const int snapTexels = caster.shadow.stabilization == Stabilization::viewSnapping ? 4 : 1;
  const LightBasis& basis = draft.bases[cascade];
  const Fit fit = draft.stable ? stableFit(sliceSphere(input.view, depths), basis, input.view.eye, snapTexels, target)
                               : tightFit(draft.receiversLs[cascade], target);

  tile.rect.width = tile.rect.height = target.tileSize;
  tile.border = target.kernel.border;
  tile.clipFromRelative = clipFromRelative(basis, fit, target.tileSize);
  tile.texelSize = fit.texelSize;
  tile.depthExtent = fit.depthExtent;
  tile.normalOffset = fit.normalOffset;
  tile.depthBias = depthBias(target.magnitude, fit.depthExtent);
  tile.receivers = maskOf(draft.pieces[cascade], fit, target);
  return tile;
}

/// Gives every tile that is drawn its place.
void placeTiles(ShadowPlan& plan) {
  std::vector<TileSquare> squares;
  std::vector<std::size_t> owners;
  for (const PlannedLight& light : plan.lights) {
    for (int cascade = 0; cascade < light.tileCount; ++cascade) {
      const std::size_t index = static_cast<std::size_t>(light.firstTile + cascade);
      if (plan.tiles[index].rect.width == 0) continue;
      squares.push_back({light.light, cascade, plan.tiles[index].rect.width});
      owners.push_back(index);
    }
  }
  const AtlasLayout layout = packSquares(squares);
  plan.atlasWidth = layout.width;
  plan.atlasHeight = layout.height;
  for (std::size_t i = 0; i < owners.size(); ++i) plan.tiles[owners[i]].rect = layout.rects[i];
}

} // namespace

ShadowPlan planShadows(const PlanInput& input) {
  std::vector<LightDraft> drafts;
  for (const DirectionalCaster& caster : input.casters) drafts.push_back(draftLight(caster, input));
  shareAtlas(drafts, input);

  ShadowPlan plan;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    PlannedLight& planned = drafts[i].planned;
    planned.firstTile = static_cast<int>(plan.tiles.size());
    planned.tileCount = static_cast<int>(drafts[i].cascades.size());
    for (std::size_t cascade = 0; cascade < drafts[i].cascades.size(); ++cascade) {
      plan.tiles.push_back(planTile(drafts[i], cascade, input.casters[i], input));
    }
    plan.lights.push_back(planned);
  }
  placeTiles(plan);
  return plan;
}

} // namespace gnomon
