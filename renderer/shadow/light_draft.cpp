#include "renderer/shadow/light_draft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/receiver_pieces.h"

namespace gnomon {
namespace {

/// The six faces of a cube whose first one looks along `front.direction`.
std::array<LightBasis, 6> cubeFaces(const LightBasis& front) {
  const glm::dvec3 a = front.direction;
  const glm::dvec3 b = front.up;
  const glm::dvec3 c = front.right; // b x c = a
  return {{{c, b, a}, {a, c, b}, {b, a, c}, {c, a, -b}, {a, b, -c}, {b, c, -a}}};
}

/// The angle from a cube's first axis at which its side faces begin.
constexpr double kSidesBegin = glm::pi<double>() / 4;

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
    draft.planned.noTexels = NoTexels::outOfRange;
    addNote(draft.planned, "nothing in view within the depth range");
  } else if (!indices.empty()) {
    addNote(draft.planned, "not drawn, no receiver in view: cascades " + indices);
  }
}

/// True where a part of the box (light space) lies in the face's pyramid.
bool mayLieIn(const Aabb& box, double tanHalf) {
  const double reach = tanHalf * box.max.z;
  return box.max.z > 0 && box.min.x <= reach && box.max.x >= -reach && box.min.y <= reach && box.max.y >= -reach;
}

/// Metres; infinite where the light has no end.
double endOf(const ShadowCaster& caster) {
  return caster.range > 0 ? caster.range : HUGE_VAL;
}

/// What the light reaches in a face, as boxes in the face's light space. `reached`: along the world's axes, relative to
/// the eye.
std::vector<Aabb> receiversIn(const LightFace& face, const ShadowCaster& caster, const std::vector<Aabb>& reached) {
  const double range = endOf(caster);
  const glm::dmat4 toLightSpace = lightFromRelative(face.basis, caster.position);
  std::vector<Aabb> receivers;
  for (const Aabb& piece : reached) {
    Aabb box = transformed(toLightSpace, piece);
    if (!mayLieIn(box, face.tanHalf)) continue;
    box.max.z = std::min(box.max.z, range);
    box.min.z = std::min(box.min.z, box.max.z);
    receivers.push_back(box);
  }
  return receivers;
}

/// The basis turned about its direction so that a rectangle around what the light reaches is small. Not for stable
/// tiles, for it changes with the camera.
LightBasis turnedTo(const std::vector<glm::dvec3>& samples, const ShadowCaster& caster, const LightFace& face) {
  constexpr double kLeastSaved = 0.1; // of the area
  const double range = endOf(caster);
  const glm::dmat3 lightFromWorld = face.basis.lightFromWorld();
  std::vector<glm::dvec2> tangents;
  for (const glm::dvec3& point : samples) {
    const glm::dvec3 at = lightFromWorld * (point - caster.position);
    if (glm::dot(at, at) > range * range) continue;
    if (at.z > 0 && std::hypot(at.x, at.y) <= face.tanHalf * at.z) tangents.emplace_back(at.x / at.z, at.y / at.z);
  }
  return rolled(face.basis, rollOfLeastArea(tangents, kLeastSaved));
}

/// All that a face can serve: its pyramid as far as the light or the scene reaches, whatever the camera sees of it.
Aabb wholeFace(const ShadowCaster& caster, const PlanInput& input, const TileDraft& tile) {
  constexpr double kRoom = 2; // surfaces are seen as boxes, which reach beyond the scene
  double far =
      kRoom *
      transformed(lightFromRelative(tile.basis, anchoredOrigin(input, tile)), anchoredBounds(input, caster)).max.z;
  for (const Aabb& piece : tile.receivers) far = std::max(far, piece.max.z);
  far = std::min(endOf(caster), far);
  const double side = tile.tanHalf * far;
  return {glm::dvec3(-side, -side, 0), glm::dvec3(side, side, far)};
}

} // namespace

glm::dvec3 anchoredOrigin(const PlanInput& input, const TileDraft& tile) {
  constexpr double kStep = 0x1p-32; // metres: far above the rounding of differences, far below anything seen
  return glm::round((tile.origin + (input.view.eye - input.anchor)) / kStep) * kStep;
}

Aabb anchoredBounds(const PlanInput& input, const ShadowCaster& caster) {
  const Aabb& bounds = caster.bounds ? *caster.bounds : input.sceneBounds;
  return {bounds.min - input.anchor, bounds.max - input.anchor};
}

void addNote(PlannedLight& light, const std::string& note) {
  if (!light.note.empty()) light.note += "; ";
  light.note += note;
}

std::vector<LightFace> facesOf(const ShadowCaster& light) {
  const LightTraits& kind = traitsOf(light.type);
  if (kind.hasCone && light.outerCone <= glm::radians(kWidestTileDegrees)) {
    return {{lightBasis(light.direction), std::tan(light.outerCone)}};
  }
  const LightBasis front = kind.hasCone ? lightBasis(light.direction) : LightBasis{};
  const std::array<LightBasis, 6> cube = cubeFaces(front);
  static_assert(kSidesBegin < glm::pi<double>() / 3); // every spot that comes here is wider
  std::vector<LightFace> faces;
  for (std::size_t i = 0; i < kind.cubeFaces; ++i) faces.push_back({cube[i], 1.0});
  return faces;
}

void draftCascades(const ShadowCaster& caster, const PlanInput& input, LightDraft& draft) {
  const Shadow& shadow = caster.shadow;
  const ReceiverDepths& receivers = receiversOf(input, caster);
  const bool manual = shadow.depthRange.mode == DepthRangeMode::manual;
  const PlannedRange planned = *depthRangeOf(input.view, receivers, shadow.depthRange);
  const DepthInterval& range = planned.covered;
  draft.planned.depthRange = planned.base;
  std::vector<double> splits = splitDistances(shadow.partition, shadow.cascadeCount, range);
  draft.planned.fadeOut = manual || splits.back() < range.far;
  for (double& split : splits) split -= input.view.ahead;
  const bool held = manual || shadow.depthRange.previous.has_value(); // not this frame's alone
  draft.stable = held && shadow.stabilization != Stabilization::none;
  const LightBasis basis = lightBasis(caster.direction);
  const std::vector<CascadeInterval> cascades = cascadeIntervals(splits, shadow.blendCascades, draft.planned.fadeOut);
  draft.tiles.resize(cascades.size());
  forEach(cascades.size(), [&](std::size_t i) {
    TileDraft& tile = draft.tiles[i];
    tile.cascade = cascades[i];
    tile.basis = draft.stable ? basis : tightBasis(input.view, receivers, basis, cascades[i]);
    tile.origin = input.anchor - input.view.eye;
    tile.receivers = receiverPieces(input.view, receivers, tile.basis, cascades[i]);
    const glm::dvec3 fromOrigin = tile.basis.lightFromWorld() * -tile.origin;
    for (Aabb& piece : tile.receivers) piece = {piece.min + fromOrigin, piece.max + fromOrigin};
  });
  if (shadow.stabilization != Stabilization::none && !draft.stable) {
    addNote(draft.planned, "stabilization is ignored, because the depth range is automatic and has no previous one");
  }
  if (!planned.note.empty()) addNote(draft.planned, planned.note);
  noteEmptyCascades(draft);
}

void draftFaces(const ShadowCaster& caster, const PlanInput& input, const SeenSurfaces& seen, LightDraft& draft) {
  draft.stable = caster.shadow.stabilization != Stabilization::none;
  std::vector<Aabb> reached;
  const double range = endOf(caster);
  std::copy_if(seen.pieces.begin(), seen.pieces.end(), std::back_inserter(reached),
               [&](const Aabb& piece) { return squaredDistance(piece, caster.position) <= range * range; });
  std::vector<LightFace> faces = facesOf(caster);
  if (faces.size() == 1 && !draft.stable) faces[0].basis = turnedTo(seen.samples, caster, faces[0]);
  for (const LightFace& face : faces) {
    TileDraft tile;
    tile.basis = face.basis;
    tile.origin = caster.position;
    tile.tanHalf = face.tanHalf;
    tile.receivers = receiversIn(face, caster, reached);
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
