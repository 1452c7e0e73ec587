#include "renderer/frame/make_report.h"

#include "renderer/frame/light_reports.h"

namespace gnomon {
namespace {

std::vector<LightReport> drawnLights(const FrameOutcome& outcome) {
  auto lights = lightReports(outcome.frame.spec, outcome.plan, outcome.errors, outcome.frame.view.eye, outcome.layered);
  for (const PlannedLight& planned : outcome.plan.lights) {
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

} // namespace

FrameReport makeReport(FrameOutcome outcome) {
  FrameReport report;
  report.spec = outcome.frame.spec;
  if (!outcome.depths.empty()) report.depthRange = {outcome.depths.nearest, outcome.depths.farthest};
  report.atlasSize = {outcome.plan.atlasWidth, outcome.plan.atlasHeight};
  report.lights = drawnLights(outcome);
  report.predictedError = outcome.errors.all;
  report.error = outcome.error;
  report.counts = countsOf(outcome);
  report.memory = outcome.facts.memory;
  report.passes = std::move(outcome.facts.passes);
  report.stages = std::move(outcome.facts.stages);
  report.warnings = outcome.frame.warnings;
  return report;
}

} // namespace gnomon
