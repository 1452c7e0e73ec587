#include "renderer/frame/make_report.h"

#include "renderer/frame/light_reports.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

std::vector<LightReport> drawnLights(const FrameStages& stages) {
  auto lights =
      lightReports(stages.frame.spec, stages.plan, stages.errors, stages.frame.view.eye, layeredLights(stages.frame));
  for (const PlannedLight& planned : stages.plan.lights) {
    LightReport& light = lights[static_cast<std::size_t>(planned.light)];
    for (std::size_t i = 0; i < light.tiles.size(); ++i) {
      const TileCounts& counts = stages.atlas.tiles[static_cast<std::size_t>(planned.firstTile) + i];
      TileReport& tile = light.tiles[i];
      tile.casterTriangles = counts.casterTriangles;
      tile.culledTriangles = counts.culledTriangles;
      tile.drawCalls = counts.drawCalls;
      tile.reused = counts.reused;
      if (!counts.timer.stopped()) continue;
      tile.cpuMilliseconds = counts.timer.cpuMilliseconds();
      tile.gpuMilliseconds = counts.timer.gpuMilliseconds();
    }
    addSums(light);
  }
  for (const auto& [samples, exact] : stages.drawn.exactShadows) {
    for (const ExactShadow& shadow : exact.lights) {
      LightReport& light = lights[static_cast<std::size_t>(shadow.light)];
      if (shadow.tracedPixels) light.tracedPixels = light.tracedPixels.value_or(0) + *shadow.tracedPixels;
      light.cpuMilliseconds = light.cpuMilliseconds.value_or(0) + shadow.milliseconds;
    }
  }
  return lights;
}

PassReport passReport(const char* name, const gl::Timer& timer, std::uint64_t drawCalls, std::uint64_t triangles) {
  PassReport pass;
  pass.pass = name;
  pass.cpuMilliseconds = timer.cpuMilliseconds();
  pass.gpuMilliseconds = timer.gpuMilliseconds();
  pass.drawCalls = drawCalls;
  pass.triangles = triangles;
  return pass;
}

std::vector<PassReport> passReports(const FrameStages& stages) {
  const Survey& survey = stages.survey;
  std::vector<PassReport> passes{passReport("survey", survey.timer, survey.drawCalls, survey.triangles)};
  if (stages.atlas.timer.stopped()) {
    std::uint64_t triangles = 0;
    for (const TileCounts& tile : stages.atlas.tiles) triangles += tile.casterTriangles;
    passes.push_back(passReport("shadow", stages.atlas.timer, stages.atlas.drawCalls, triangles));
  }
  for (const auto& [samples, surfaces] : stages.drawn.surfaces) {
    passes.push_back(passReport("surfaces", surfaces.timer, surfaces.drawCalls, surfaces.triangles));
  }
  for (const auto& [samples, exact] : stages.drawn.exactShadows) {
    passes.push_back(passReport("visibility", exact.timer, exact.drawCalls, exact.triangles));
  }
  for (std::size_t i = 0; i < stages.drawn.views.size(); ++i) {
    const DrawnView& view = stages.drawn.views[i];
    if (!view.timer.stopped()) continue; // read from a target that is there anyway
    passes.push_back(passReport("view", view.timer, 1, 1));
    passes.back().view = stages.frame.spec.views[i];
  }
  for (const auto& [name, view] : stages.drawn.besides) {
    passes.push_back(passReport("view", view.timer, 1, 1));
    passes.back().view = name;
  }
  return passes;
}

FrameCounts countsOf(const FrameStages& stages, const std::vector<PassReport>& passes) {
  FrameCounts counts;
  counts.sceneTriangles = stages.scene.triangles;
  counts.surveyedTriangles = stages.survey.triangles;
  for (const TileCounts& tile : stages.atlas.tiles) counts.casterTriangles += tile.casterTriangles;
  for (const auto& [samples, surfaces] : stages.drawn.surfaces) counts.shadedTriangles += surfaces.triangles;
  counts.drawCalls = stages.drawn.casters.drawCalls;
  for (const PassReport& pass : passes) counts.drawCalls += pass.drawCalls;
  return counts;
}

MemoryReport memoryOf(const FrameStages& stages) {
  MemoryReport memory;
  memory.scene = stages.gpu.bytes + stages.gpu.materialData.bytes();
  memory.atlas = stages.atlas.textures->bytes();
  memory.targets = stages.survey.depth.bytes();
  for (const auto& [samples, surfaces] : stages.drawn.surfaces) {
    memory.targets += surfaces.bits.bytes() + surfaces.emission.bytes() + surfaces.ownDepth.bytes();
  }
  for (const auto& [samples, exact] : stages.drawn.exactShadows) {
    memory.targets += exact.layers.texture.bytes() + exact.countBytes;
  }
  for (const DrawnView& view : stages.drawn.views) memory.targets += view.color.bytes();
  for (const auto& [name, view] : stages.drawn.besides) memory.targets += view.color.bytes();
  return memory;
}

} // namespace

FrameReport makeReport(const FrameStages& stages, std::vector<StageTime> times) {
  FrameReport report;
  report.spec = stages.frame.spec;
  const DepthSpan& range = stages.survey.receivers.range;
  if (!range.empty()) report.depthRange = {range.nearest, range.farthest};
  report.atlasSize = {stages.plan.atlasWidth, stages.plan.atlasHeight};
  report.lights = drawnLights(stages);
  report.predictedError = stages.errors.all;
  report.error = stages.error;
  report.passes = passReports(stages);
  report.counts = countsOf(stages, report.passes);
  report.memory = memoryOf(stages);
  report.stages = std::move(times);
  report.warnings = stages.frame.warnings;
  return report;
}

} // namespace gnomon
