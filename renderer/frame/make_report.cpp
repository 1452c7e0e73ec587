#include "renderer/frame/make_report.h"

#include <algorithm>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/core/light.h"
#include "renderer/shadow/filter_kernel.h"

namespace gnomon {

LightMapReport lightMapReport(const LightMapCache::Found& found) {
  const LightMapLayout& layout = *found.baked->layout;
  const auto authored = std::count(layout.authored.begin(), layout.authored.end(), 1);
  return {.reused = found.reused,
          .width = layout.width,
          .height = layout.height,
          .texelsPerMetre = layout.texelsPerMetre,
          .charts = layout.charts.size(),
          .authoredInstances = static_cast<std::uint64_t>(authored),
          .madeInstances = layout.authored.size() - static_cast<std::uint64_t>(authored),
          .bytes = found.baked->bytes(),
          .bakeMilliseconds = found.baked->milliseconds};
}

namespace {

std::vector<LightReport> drawnLights(const FrameOutcome& outcome) {
  auto lights = lightReports(outcome.frame, outcome.plans, outcome.errors, outcome.layered);
  for (const PlannedLight& planned : outcome.plans.drawn.lights) {
    LightReport& light = lights[static_cast<std::size_t>(planned.light)];
    for (std::size_t i = 0; i < light.tiles.size(); ++i) {
      const TileFacts& facts = outcome.facts.tiles[static_cast<std::size_t>(planned.firstTile) + i];
      TileReport& tile = light.tiles[i];
      tile.casterTriangles = facts.casterTriangles;
      tile.culledTriangles = facts.culledTriangles;
      tile.drawCalls = facts.drawCalls;
      tile.reused = facts.reused;
      if (!facts.time) continue;
      tile.cpuMilliseconds = facts.time->cpuMilliseconds;
      tile.gpuMilliseconds = facts.time->gpuMilliseconds;
    }
    addSums(light);
  }
  for (std::size_t i = 0; i < outcome.baked.size(); ++i) {
    if (outcome.baked[i].baked) lights[i].lightMap = lightMapReport(outcome.baked[i]);
  }
  for (const LayerFacts& layer : outcome.facts.layers) {
    LightReport& light = lights[static_cast<std::size_t>(layer.light)];
    if (layer.tracedPixels) light.tracedPixels = light.tracedPixels.value_or(0) + *layer.tracedPixels;
    light.cpuMilliseconds = light.cpuMilliseconds.value_or(0) + layer.cpuMilliseconds;
  }
  return lights;
}

FrameCounts countsOf(const FrameOutcome& outcome) {
  FrameCounts counts;
  counts.sceneTriangles = outcome.sceneTriangles;
  counts.surveyedTriangles = outcome.facts.surveyedTriangles;
  counts.shadedTriangles = outcome.facts.shadedTriangles;
  for (const TileFacts& tile : outcome.facts.tiles) counts.casterTriangles += tile.casterTriangles;
  counts.drawCalls = outcome.facts.otherDrawCalls;
  for (const PassReport& pass : outcome.facts.passes) counts.drawCalls += pass.drawCalls;
  return counts;
}

std::array<double, 16> clipFromWorld(const ShadowTile& tile, const glm::dvec3& eye) {
  glm::dmat4 matrix = tile.clipFromRelative;
  matrix[3] = matrix * glm::dvec4(-eye, 1.0);
  std::array<double, 16> columns{};
  for (int i = 0; i < 16; ++i) columns[static_cast<std::size_t>(i)] = matrix[i / 4][i % 4];
  return columns;
}

/// Offsets at the far end of a face, which is where they are largest along the normal; anywhere in a cascade.
void addBias(const ShadowTile& tile, const Bias& bias, TileReport& report) {
  const Fit& fit = tile.space.fit;
  report.normalOffset = manualOffset(bias).value_or(fit.normalOffset * (fit.perspective ? tile.far : 1.0));
  if (!fit.perspective) {
    report.depthBias = tile.depthBias;
    report.depthBiasMetres = tile.depthBias * fit.depthExtent;
    return;
  }
  report.depthBias = tile.depthBias + tile.depthBiasNear / (tile.far * tile.far);
  // z = far (1 - near / distance) / extent
  const double zPerMetre = fit.depthNear / (tile.far * fit.depthExtent);
  report.depthBiasMetres = report.depthBias / zPerMetre;
}

TileReport tileReport(const ShadowTile& tile, LightType type, const Bias& bias,
                      const std::optional<PredictedError>& error, const CameraView& view) {
  TileReport report;
  const double ahead = traitsOf(type).parallel ? view.ahead : 0.0;
  report.near = tile.near + ahead;
  report.far = tile.far + ahead;
  if (tile.rect.width == 0) return report;
  const glm::dvec2 texelSize = tile.space.fit.texelSize * (tile.space.fit.perspective ? tile.far : 1.0);
  report.tile = {tile.rect.x, tile.rect.y, tile.rect.width, tile.rect.height};
  report.border = tile.border;
  report.texelSize = {texelSize.x, texelSize.y};
  report.matrix = clipFromWorld(tile, view.eye);
  addBias(tile, bias, report);
  report.predictedError = error;
  return report;
}

void addTo(std::optional<double>& sum, const std::optional<double>& part) {
  if (part) sum = sum.value_or(0.0) + *part;
}

/// A light with a size whose technique ignores it, or one without whose filter needs it.
std::string sharpNote(const Light& light) {
  const bool sized = hasSize(light);
  const TechniqueTraits& technique = traitsOf(light.shadow->technique);
  if (!technique.layered) {
    const bool wanted = light.shadow->filter.type == FilterType::pcss;
    if (wanted == sized) return "";
    return wanted ? "it has no size: filter pcss draws its shadow sharp"
                  : "its size is ignored: of all filters only pcss knows it";
  }
  if (!sized || technique.knowsSize) return "";
  return "its size is ignored: technique " + std::string(spell(light.shadow->technique)) + " draws sharp shadows only";
}

/// Settings that were asked for and that nothing reads.
std::string unusedNote(const Light& light, bool mapped) {
  std::string names;
  for (const std::string_view name : unusedSettings(light, mapped)) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  if (names.empty()) return "";
  return "without effect with technique " + std::string(spell(light.shadow->technique)) + ": " + names;
}

/// The notes that are not empty, one after the other.
std::string joined(std::initializer_list<std::string> notes) {
  std::string all;
  for (const std::string& note : notes) {
    if (!note.empty()) all += (all.empty() ? "" : "; ") + note;
  }
  return all;
}

/// `errors`: one a tile of the plan; empty = the tiles are not drawn.
void addTiles(const ResolvedFrame& frame, const ShadowPlan& plan, const PlannedLight& planned,
              std::span<const std::optional<PredictedError>> errors, LightReport& report) {
  const Light& light = (*frame.spec.lights)[static_cast<std::size_t>(planned.light)];
  report.askedTileSize = planned.askedTileSize;
  report.grantedTileSize = planned.grantedTileSize;
  // A frame that sees nothing hands its predecessor's range on.
  report.depthRange = light.shadow->depthRange.previous;
  if (planned.depthRange) report.depthRange = PreviousRange{planned.depthRange->near, planned.depthRange->far};
  for (int tile = planned.firstTile; tile < planned.firstTile + planned.tileCount; ++tile) {
    const auto index = static_cast<std::size_t>(tile);
    report.tiles.push_back(tileReport(plan.tiles[index], light.type, light.shadow->bias,
                                      errors.empty() ? std::nullopt : errors[index], frame.view));
  }
}

} // namespace

FrameReport makeReport(FrameOutcome outcome) {
  FrameReport report;
  report.spec = outcome.frame.spec;
  report.depthRange = askedDepths(outcome.frame.view, outcome.depths);
  report.atlasSize = {outcome.plans.drawn.atlasWidth, outcome.plans.drawn.atlasHeight};
  report.lights = drawnLights(outcome);
  report.volumes.assign(outcome.volumes.begin(), outcome.volumes.end());
  report.predictedError = outcome.errors.all;
  report.error = outcome.error;
  report.counts = countsOf(outcome);
  report.memory = outcome.facts.memory;
  report.passes = std::move(outcome.facts.passes);
  report.stages = std::move(outcome.facts.stages);
  report.warnings = outcome.frame.warnings;
  return report;
}

bool isPlanned(const ShadowPlan& plan, int light) {
  return std::any_of(plan.lights.begin(), plan.lights.end(),
                     [&](const PlannedLight& each) { return each.light == light; });
}

std::array<double, 2> askedDepths(const CameraView& view, const DepthSpan& depths) {
  if (depths.empty()) return {};
  return {depths.nearest + view.ahead, depths.farthest + view.ahead};
}

std::vector<LightReport> lightReports(const ResolvedFrame& frame, const FramePlans& plans,
                                      const PredictedErrors& errors, std::span<const int> layeredLights,
                                      const PredictedErrors& wholeErrors) {
  const std::vector<Light>& lights = *frame.spec.lights;
  std::vector<LightReport> reports;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    LightReport report;
    report.light = static_cast<int>(i);
    report.note = !lights[i].shadow->enabled ? "its shadow is disabled"
                  : lights[i].intensity <= 0
                      ? "its intensity is 0"
                      : "shadowLightPolicy is first, and this is not the first directional light";
    if (i < frame.choices.size()) report.choice = frame.choices[i];
    reports.push_back(std::move(report));
  }
  for (const int layered : layeredLights) {
    LightReport& report = reports[static_cast<std::size_t>(layered)];
    const Light& light = lights[static_cast<std::size_t>(layered)];
    const bool mapped = isPlanned(plans.drawn, layered) || isPlanned(plans.whole, layered);
    report.shadowed = true;
    report.note = joined({sharpNote(light), unusedNote(light, mapped)});
  }
  for (std::size_t i = 0; i < plans.whole.lights.size(); ++i) {
    const PlannedLight& planned = plans.whole.lights[i];
    LightReport& report = reports[static_cast<std::size_t>(planned.light)];
    addTiles(frame, plans.whole, planned, wholeErrors.tiles, report);
    if (!wholeErrors.lights.empty()) report.predictedError = wholeErrors.lights[i];
    if (planned.tileCount == 0 && planned.noTexels == NoTexels::none) {
      report.note = joined({planned.note, report.note});
    }
  }
  for (std::size_t i = 0; i < plans.drawn.lights.size(); ++i) {
    const PlannedLight& planned = plans.drawn.lights[i];
    LightReport& report = reports[static_cast<std::size_t>(planned.light)];
    report.tiles.clear();
    addTiles(frame, plans.drawn, planned, errors.tiles, report);
    report.shadowed = report.shadowed || planned.tileCount > 0;
    const Light& light = lights[static_cast<std::size_t>(planned.light)];
    report.note = joined({planned.note, report.shadowed ? sharpNote(light) : "", unusedNote(light, true)});
    report.predictedError = errors.lights[i];
  }
  return reports;
}

void addSums(LightReport& light) {
  for (const TileReport& tile : light.tiles) {
    light.casterTriangles += tile.casterTriangles;
    light.drawCalls += tile.drawCalls;
    addTo(light.cpuMilliseconds, tile.cpuMilliseconds);
    addTo(light.gpuMilliseconds, tile.gpuMilliseconds);
  }
}

} // namespace gnomon
