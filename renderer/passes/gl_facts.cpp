#include "renderer/passes/gl_facts.h"

namespace gnomon {
namespace {

PassReport passReport(const char* name, const gl::Timer& timer, std::uint64_t drawCalls, std::uint64_t triangles) {
  PassReport pass;
  pass.pass = name;
  pass.cpuMilliseconds = timer.cpuMilliseconds();
  pass.gpuMilliseconds = timer.gpuMilliseconds();
  pass.drawCalls = drawCalls;
  pass.triangles = triangles;
  return pass;
}

std::vector<PassReport> passReports(const PassResults& results) {
  const Survey& survey = results.survey;
  std::vector<PassReport> passes{passReport("survey", survey.timer, survey.drawCalls, survey.triangles)};
  if (results.atlas.timer.stopped()) {
    std::uint64_t triangles = 0;
    for (const TileCounts& tile : results.atlas.tiles) triangles += tile.casterTriangles;
    passes.push_back(passReport("shadow", results.atlas.timer, results.atlas.drawCalls, triangles));
  }
  for (const auto& [samples, surfaces] : results.drawn.surfaces) {
    passes.push_back(passReport("surfaces", surfaces.timer, surfaces.drawCalls, surfaces.triangles));
  }
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    passes.push_back(passReport("visibility", exact.timer, exact.drawCalls, exact.triangles));
  }
  for (std::size_t i = 0; i < results.drawn.views.size(); ++i) {
    const DrawnView& view = results.drawn.views[i];
    if (!view.timer.stopped()) continue; // read from a target that is there anyway
    passes.push_back(passReport("view", view.timer, 1, 1));
    passes.back().view = results.views[i].view;
  }
  return passes;
}

MemoryReport memoryOf(const PassResults& results) {
  MemoryReport memory;
  memory.scene = results.gpu.bytes + results.gpu.materialData.bytes();
  memory.atlas = results.atlas.textures->bytes();
  memory.targets = results.survey.depth.bytes();
  for (const auto& [samples, surfaces] : results.drawn.surfaces) {
    memory.targets += surfaces.bits.bytes() + surfaces.emission.bytes() + surfaces.ownDepth.bytes();
  }
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    memory.targets += exact.layers.texture.bytes() + exact.countBytes;
  }
  for (const DrawnView& view : results.drawn.views) memory.targets += view.color.bytes();
  return memory;
}

TileFacts tileFacts(const TileCounts& counts) {
  TileFacts facts{counts.casterTriangles, counts.culledTriangles, counts.drawCalls, counts.reused};
  if (counts.timer.stopped()) facts.time = WorkTime{counts.timer.cpuMilliseconds(), counts.timer.gpuMilliseconds()};
  return facts;
}

} // namespace

FrameFacts factsOf(const PassResults& results) {
  FrameFacts facts;
  for (const TileCounts& counts : results.atlas.tiles) facts.tiles.push_back(tileFacts(counts));
  for (const auto& [samples, exact] : results.drawn.exactShadows) {
    facts.layers.insert(facts.layers.end(), exact.lights.begin(), exact.lights.end());
  }
  facts.passes = passReports(results);
  facts.surveyedTriangles = results.survey.triangles;
  for (const auto& [samples, surfaces] : results.drawn.surfaces) facts.shadedTriangles += surfaces.triangles;
  facts.otherDrawCalls = results.drawn.casters.drawCalls;
  facts.memory = memoryOf(results);
  return facts;
}

} // namespace gnomon
