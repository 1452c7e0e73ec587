#include "renderer/shadow/shadow_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/filter_kernel.h"
#include "renderer/shadow/fit.h"
#include "renderer/shadow/light_draft.h"
#include "renderer/shadow/penumbra_reach.h"
#include "renderer/shadow/receiver_pieces.h"
#include "renderer/shadow/tile_size.h"

namespace gnomon {

namespace {

std::string texels(int size) {
  return std::to_string(size) + " x " + std::to_string(size) + " texels";
}

/// Why no shadow of this light needs to be drawn; nothing where one may.
std::optional<std::string> reasonToSkip(const ShadowCaster& caster, const PlanInput& input) {
  if (!caster.shadow.enabled) return "the light's shadow is disabled";
  if (caster.shadow.strength <= 0) return "the shadow's strength is 0";
  if (input.receivers.range.empty()) return "nothing in view";
  if (input.sceneBounds.empty()) return "nothing in the scene casts a shadow";
  if (!caster.casts) return "nothing that it lights casts a shadow";
  if (!caster.shadows) return "nothing that it lights receives a shadow";
  if (receiversOf(input, caster).range.empty()) return "nothing in view receives its shadow";
  return std::nullopt;
}

SeenSurfaces seenSurfaces(const CameraView& view, const ReceiverDepths& receivers) {
  const DepthSpan& range = receivers.range;
  const LightBasis worldAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return {receiverPieces(view, receivers, worldAxes, {range.nearest, range.farthest, range.farthest}),
          sampledReceivers(view, receivers, {range.nearest, range.farthest})};
}

/// What lights from a point ask for, by their part of what is seen (ShadowCaster::part).
std::map<int, SeenSurfaces> surfacesOfParts(const PlanInput& input) {
  std::map<int, SeenSurfaces> seen;
  for (const ShadowCaster& caster : input.casters) {
    if (traitsOf(caster.type).parallel || seen.contains(caster.part)) continue;
    const ReceiverDepths& receivers = receiversOf(input, caster);
    seen[caster.part] = receivers.range.empty() ? SeenSurfaces{} : seenSurfaces(input.view, receivers);
  }
  return seen;
}

LightDraft draftLight(const ShadowCaster& caster, const PlanInput& input, const std::map<int, SeenSurfaces>& seen) {
  LightDraft draft;
  draft.planned.light = caster.light;
  if (caster.shadow.enabled && caster.shadow.strength > 0) {
    draft.planned.askedTileSize =
        askedTileSize(caster.shadow.size.value_or(ShadowSize::Large), caster.shadow.importance, input.atlas.baseSize,
                      lightSize(caster, input.view, input.frameWidth, input.frameHeight));
  }
  if (const auto reason = reasonToSkip(caster, input)) {
    draft.planned.note = *reason;
  } else if (draft.planned.askedTileSize == 0) {
    draft.planned.note = "what it reaches is out of view";
  } else if (traitsOf(caster.type).parallel) {
    draftCascades(caster, input, draft);
  } else {
    draftFaces(caster, input, seen.at(caster.part), draft);
  }
  return draft;
}

int drawnTiles(const LightDraft& draft) {
  return static_cast<int>(std::count_if(draft.tiles.begin(), draft.tiles.end(),
                                        [](const TileDraft& tile) { return !tile.receivers.empty(); }));
}

/// Decides the tile size of every light; a light that is refused loses its cascades.
void shareAtlas(std::vector<LightDraft>& drafts, const PlanInput& input) {
  const int side = static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::max(0, std::min(input.atlas.size, input.maxTextureSize)))));
  std::vector<TileRequest> requests;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const PlannedLight& planned = drafts[i].planned;
    requests.push_back({planned.light, drawnTiles(drafts[i]), std::max(planned.askedTileSize, kSmallestTile),
                        input.casters[i].shadow.importance});
  }
  const std::vector<int> sizes = grantTileSizes(requests, side);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    LightDraft& draft = drafts[i];
    if (draft.tiles.empty()) continue;
    PlannedLight& planned = draft.planned;
    planned.grantedTileSize = sizes[i];
    if (sizes[i] == 0) {
      draft.tiles.clear();
      planned.noTexels = NoTexels::atlasFull;
      addNote(planned, "no room in the atlas of " + texels(side));
    } else if (sizes[i] < planned.askedTileSize) {
      addNote(planned, "tiles of " + texels(sizes[i]) + " instead of " + texels(planned.askedTileSize) +
                           ": the atlas of " + texels(side) + " is full");
    } else if (sizes[i] > planned.askedTileSize) {
      addNote(planned, "tiles of " + texels(sizes[i]) + " instead of " + texels(planned.askedTileSize) +
                           ": the smallest that the filter can use");
    }
  }
}

/// What the filter reads around the receivers, once they are moved along their normals; all of a stable tile, so that
/// it holds for other cameras, too.
ReceiverMask maskOf(const TileDraft& draft, const LightDraft& light, const ShadowTile& tile, double depthSlack) {
  if (light.stable) return receiverMask({{glm::dvec3(-1, -1, 0), glm::dvec3(1)}}, glm::dvec2(0.0));
  std::vector<Aabb> clip;
  clip.reserve(draft.receivers.size());
  for (const Aabb& piece : draft.receivers) {
    Aabb box = clipBox(tile.space, piece);
    box.max.z += depthSlack;
    clip.push_back(box);
  }
  const Fit& fit = tile.space.fit;
  const glm::dvec2 reach =
      fit.texelSize * static_cast<double>(tile.border) + fit.radius + fit.normalOffset * (1.0 + draft.tanHalf);
  return receiverMask(clip, reach * 2.0 / (fit.texelSize * static_cast<double>(tile.space.size)));
}

/// An orthographic depth buffer rounds by a share of its whole length, not of the depth. What this adds to the
/// magnitude of which depthRounding is a share: two steps of 2^-24.
double orthographicReach(const CameraView& view) {
  return view.perspective ? 0.0 : 0.1 * (drawnFar(view) - drawnNear(view));
}

glm::dmat4 lightFromAnchored(const TileDraft& draft, const PlanInput& input) {
  return lightFromRelative(draft.basis, anchoredOrigin(input, draft));
}

/// Metres: no two points of what takes part in a light's shadows are farther apart, and none is from the anchor.
double extentOf(const PlanInput& input, const ShadowCaster& caster) {
  const Aabb bounds = anchoredBounds(input, caster);
  return std::max(glm::length(bounds.max - bounds.min),
                  glm::length(glm::max(glm::abs(bounds.min), glm::abs(bounds.max))));
}

/// The reach of a search for casters. A stable fit's is one for every place of the camera: between the scene's two ends
/// along the light, and what a slice of the view may lie beyond them.
void addPenumbra(const TileDraft& draft, const LightDraft& light, const ShadowCaster& caster, const PlanInput& input,
                 double sliceRadius, FitTarget& target) {
  const Aabb scene = anchoredBounds(input, caster);
  const glm::dmat4 toLight = lightFromAnchored(draft, input);
  if (light.stable) {
    const Aabb box = transformed(toLight, scene);
    target.nearestCaster = box.min.z;
    target.kernel.radius = target.kernel.lightRadius * (box.max.z - box.min.z + sliceRadius);
    return;
  }
  const PenumbraReach reach = penumbraReach(boxAround(draft.receivers), scene, toLight, target.kernel.lightRadius);
  target.nearestCaster = reach.nearest;
  target.kernel.radius = reach.radius;
}

Fit cascadeFit(const TileDraft& draft, const LightDraft& light, const ShadowCaster& caster, const PlanInput& input,
               FitTarget& target) {
  const DepthInterval depths{draft.cascade.near - depthSlack(input.view, draft.cascade.near),
                             draft.cascade.far + depthSlack(input.view, draft.cascade.far)};
  // No term of these moves with the camera or the lens, so that a stable fit keeps its extents.
  const CameraView lens = light.stable ? steppedLens(input.view) : input.view;
  const Sphere slice = sliceSphere(lens, depths);
  target.reach = sliceReach(lens, depths);
  // The eye of an orthographic view may be moved along its axis.
  if (light.stable && !lens.perspective) target.reach = std::exp2(std::ceil(std::log2(target.reach)));
  target.magnitude = target.reach + extentOf(input, caster) + orthographicReach(input.view);
  if (target.kernel.kind == MapReadingKind::pcss) addPenumbra(draft, light, caster, input, slice.radius, target);
  const int snapTexels = caster.shadow.stabilization == Stabilization::viewSnapping ? 4 : 1;
  return light.stable ? stableFit(slice, draft.basis, input.view.eye - input.anchor, snapTexels, target)
                      : tightFit(boxAround(draft.receivers), target);
}

/// A face's magnitude (FitTarget), and the finest texel that it leaves. What a tile computes of a place is a sum of
/// products with the place relative to the eye, or to the anchor, and of an offset that takes it to the tile: none is
/// larger than the way from there to the tile's far corners. So a light that is far from all that it is seen to light
/// counts no more than they do.
void addMagnitude(const TileDraft& draft, const LightDraft& light, const ShadowCaster& caster, const PlanInput& input,
                  const Aabb& seen, FitTarget& target) {
  constexpr double kRoom = 4; // for the roundings of a quotient
  const double fromAnchor = glm::length(anchoredOrigin(input, draft));
  const double extent = extentOf(input, caster);
  const double fromEye = light.stable ? extent : glm::length(draft.origin); // a stable fit does not depend on the eye
  target.magnitude = std::max(fromEye, fromAnchor) + seen.max.z * (1.0 + std::sqrt(2.0) * draft.tanHalf);
  if (!light.stable) {
    const glm::dvec3 eye = draft.basis.lightFromWorld() * -draft.origin;
    double farthest = 0;
    for (const Aabb& piece : draft.receivers) {
      farthest = std::max(farthest, glm::length(glm::max(glm::abs(piece.min - eye), glm::abs(piece.max - eye))));
    }
    const double across = seen.max.z * glm::length(glm::dvec2(seen.max - seen.min));
    const double byPlaces = farthest + extent + across;
    if (byPlaces < target.magnitude) {
      target.magnitude = byPlaces;
      target.finestTangent = std::min(target.finestTangent, kRoom * finestTexel(byPlaces) / seen.min.z);
    }
  }
  target.magnitude += orthographicReach(input.view);
}

Fit faceFit(const TileDraft& draft, const LightDraft& light, const ShadowCaster& caster, const PlanInput& input,
            FitTarget& target) {
  const Aabb seen = tangentsOf(draft.receivers, draft.tanHalf);
  addMagnitude(draft, light, caster, input, seen, target);
  if (target.kernel.kind == MapReadingKind::pcss) {
    target.nearestCaster = nearestCasterInPyramid(seen, anchoredBounds(input, caster), lightFromAnchored(draft, input),
                                                  target.kernel.lightRadius, kWidestTangent);
  }
  return punctualFit(seen, draft.tanHalf, target);
}

ShadowTile planTile(const TileDraft& draft, const LightDraft& light, const ShadowCaster& caster,
                    const PlanInput& input) {
  ShadowTile tile;
  tile.near = draft.cascade.near;
  tile.far = draft.cascade.far;
  tile.blendNear = draft.cascade.blendNear;
  tile.filter = kernelOf(caster.shadow.filter, caster.lightRadius);
  tile.space.basis = draft.basis;
  if (draft.receivers.empty()) return tile;

  FitTarget target;
  target.tileSize = light.planned.grantedTileSize;
  target.kernel = tile.filter;
  target.manualOffset = manualOffset(caster.shadow.bias);
  const bool parallel = traitsOf(caster.type).parallel;
  const Fit fit =
      parallel ? cascadeFit(draft, light, caster, input, target) : faceFit(draft, light, caster, input, target);

  tile.rect.width = tile.rect.height = target.tileSize;
  tile.border = target.kernel.border;
  const glm::dvec3 anchored = anchoredOrigin(input, draft);
  tile.space = {draft.basis, anchored - (input.view.eye - input.anchor), fit, target.tileSize};
  tile.clipFromRelative = clipFromLight(tile.space) * lightFromRelative(draft.basis, tile.space.origin);
  tile.clipFromAnchored = clipFromLight(tile.space) * lightFromRelative(draft.basis, anchored);
  if (parallel) {
    tile.depthBias = depthBias(target.magnitude, fit.depthExtent);
    tile.receivers = maskOf(draft, light, tile, 2.0 * tile.depthBias);
    return tile;
  }
  tile.near = fit.depthNear;
  tile.far = tile.blendNear = fit.depthNear + fit.depthExtent;
  tile.depthBias = punctualDepthQuantum();
  tile.depthBiasNear = depthRounding(target.magnitude) * tile.near * tile.far / fit.depthExtent;
  tile.receivers = maskOf(draft, light, tile, 2.0 * (tile.depthBias + tile.depthBiasNear / (tile.near * tile.near)));
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
  const std::map<int, SeenSurfaces> seen = surfacesOfParts(input);
  for (const ShadowCaster& caster : input.casters) drafts.push_back(draftLight(caster, input, seen));
  shareAtlas(drafts, input);

  ShadowPlan plan;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    PlannedLight& planned = drafts[i].planned;
    planned.firstTile = static_cast<int>(plan.tiles.size());
    planned.tileCount = static_cast<int>(drafts[i].tiles.size());
    const std::size_t first = plan.tiles.size();
    plan.tiles.resize(first + drafts[i].tiles.size());
    forEach(drafts[i].tiles.size(), [&](std::size_t tile) {
      plan.tiles[first + tile] = planTile(drafts[i].tiles[tile], drafts[i], input.casters[i], input);
    });
    plan.lights.push_back(planned);
  }
  placeTiles(plan);
  return plan;
}

} // namespace gnomon
