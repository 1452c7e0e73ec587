#include "renderer/resolve/resolve_debug.h"

#include <algorithm>
#include <string>

#include "protocol/spec/debug_light.h"
#include "renderer/core/collect.h"
#include "renderer/resolve/check_frame.h"

namespace gnomon {
namespace {

bool shows(const FrameSpec& spec, View view) {
  return std::find(spec.views.begin(), spec.views.end(), view) != spec.views.end();
}

const PlannedLight* plannedOf(const ShadowPlan& plan, int light) {
  const auto found = std::find_if(plan.lights.begin(), plan.lights.end(),
                                  [light](const PlannedLight& planned) { return planned.light == light; });
  return found == plan.lights.end() ? nullptr : &*found;
}

/// debug.light, else the first that casts, else the first.
int lightToShow(const FrameSpec& spec, const ShadowPlan& plan, std::span<const int> layeredLights) {
  if (showsEnvironment(spec.debug)) return kEnvironmentLight;
  if (const auto light = debugLightIndex(spec.debug)) return *light;
  for (int light = 0; light < static_cast<int>(spec.lights->size()); ++light) {
    const PlannedLight* planned = plannedOf(plan, light);
    const bool layered = std::find(layeredLights.begin(), layeredLights.end(), light) != layeredLights.end();
    if (layered || (planned != nullptr && planned->tileCount > 0)) return light;
  }
  return spec.lights->empty() ? -1 : 0;
}

Problem noAtlas(const char* view) {
  return {ProblemCode::invalidValue, "/views", "This frame has no shadow atlas: no light casts in it.", "", view};
}

std::string upTo(int count) {
  return "0.." + std::to_string(count - 1);
}

Result<const ShadowTile*> tileToShow(const FrameSpec& spec, const ShadowPlan& plan, const DebugSubject& subject) {
  if (subject.planned == nullptr || subject.planned->tileCount == 0) {
    if (!spec.debug.light) return noAtlas("tile");
    const std::string note = subject.planned == nullptr ? "" : ": " + subject.planned->note;
    return Problem{ProblemCode::invalidValue, "/debug/light", "This light casts no shadow in this frame" + note + ".",
                   "", showsEnvironment(spec.debug) ? kEnvironmentName : std::to_string(subject.light)};
  }
  const PlannedLight& light = *subject.planned;
  if (spec.debug.tile >= light.tileCount) {
    return Problem{ProblemCode::invalidValue, "/debug/tile",
                   "Light " + std::to_string(light.light) + " has tiles " + upTo(light.tileCount) + " in this frame.",
                   upTo(light.tileCount), std::to_string(spec.debug.tile)};
  }
  const auto first = plan.tiles.begin() + light.firstTile;
  const ShadowTile& tile = first[spec.debug.tile];
  if (tile.rect.width > 0) return &tile;
  std::string drawn;
  for (int i = 0; i < light.tileCount; ++i) {
    if (first[i].rect.width > 0) drawn += (drawn.empty() ? "" : ", ") + std::to_string(i);
  }
  return Problem{ProblemCode::invalidValue, "/debug/tile", "This tile was not drawn: nothing in view lies in it.",
                 drawn, std::to_string(spec.debug.tile)};
}

} // namespace

Status checkDebugLight(const Debug& debug, std::size_t lightCount) {
  const auto light = debugLightIndex(debug);
  if (!light || static_cast<std::size_t>(*light) < lightCount) return Done{};
  return Problem{ProblemCode::invalidValue, "/debug/light", "The frame has no light of that index.",
                 lightCount == 0 ? "no lights" : upTo(static_cast<int>(lightCount)), std::to_string(*light)};
}

Result<DebugSubject> debugSubject(const FrameSpec& spec, const ShadowPlan& plan, std::span<const int> layeredLights) {
  DebugSubject subject;
  subject.light = lightToShow(spec, plan, layeredLights);
  subject.planned = plannedOf(plan, subject.light);
  if (subject.planned != nullptr) subject.index = static_cast<std::size_t>(subject.planned - plan.lights.data());
  if (plan.atlasWidth == 0 && shows(spec, View::atlas)) return noAtlas("atlas");
  if (shows(spec, View::tile)) {
    const auto tile = tileToShow(spec, plan, subject);
    if (!tile) return tile.problems();
    subject.tile = *tile;
  }
  return subject;
}

Result<DebugSubject> settlePlan(const FrameSpec& spec, const ShadowPlan& plan, std::span<const int> layeredLights) {
  ProblemList problems;
  collect(checkAtlas(plan, spec.atlas.samples), problems);
  const auto subject = collect(debugSubject(spec, plan, layeredLights), problems);
  if (!subject || !problems.empty()) return std::move(problems).take();
  return *subject;
}

} // namespace gnomon
