#include "renderer/make_report.h"

namespace gnomon {
namespace {

CascadeReport cascadeReport(const ShadowTile& tile, const TileCounts& counts) {
  const glm::dvec2 texelSize = tile.space.fit.texelSize * (tile.space.fit.perspective ? tile.far : 1.0);
  return {tile.near,
          tile.far,
          {tile.rect.x, tile.rect.y, tile.rect.width, tile.rect.height},
          {texelSize.x, texelSize.y},
          counts.casterTriangles,
          counts.culledTriangles};
}

std::vector<LightReport> lightReports(const FrameSpec& spec, const ShadowPlan& plan, const ShadowAtlas& atlas) {
  std::vector<LightReport> reports;
  for (std::size_t i = 0; i < spec.lights->size(); ++i) {
    LightReport report;
    report.light = static_cast<int>(i);
    const Light& light = (*spec.lights)[i];
    report.note = light.shadow->enabled ? "shadowLightPolicy is first, and this is not the first directional light"
                                        : "its shadow is turned off";
    reports.push_back(std::move(report));
  }
  for (const PlannedLight& planned : plan.lights) {
    LightReport& report = reports[static_cast<std::size_t>(planned.light)];
    report.shadowed = planned.tileCount > 0;
    report.askedTileSize = planned.askedTileSize;
    report.grantedTileSize = planned.grantedTileSize;
    report.note = planned.note;
    for (int i = 0; i < planned.tileCount; ++i) {
      const auto tile = static_cast<std::size_t>(planned.firstTile + i);
      report.cascades.push_back(cascadeReport(plan.tiles[tile], atlas.tiles[tile]));
    }
  }
  return reports;
}

} // namespace

FrameReport makeReport(const ResolvedFrame& frame, const SceneView& scene, const Survey& survey, const ShadowPlan& plan,
                       const ShadowAtlas& atlas, const DrawnViews& drawn, std::vector<StageTime> stages) {
  FrameReport report;
  report.spec = frame.spec;
  if (!survey.receivers.range.empty()) {
    report.depthRange = {survey.receivers.range.nearest, survey.receivers.range.farthest};
  }
  report.atlasSize = {plan.atlasWidth, plan.atlasHeight};
  report.lights = lightReports(frame.spec, plan, atlas);
  report.counts.sceneTriangles = scene.triangles;
  report.counts.surveyedTriangles = survey.triangles;
  report.counts.drawCalls = survey.drawCalls + atlas.drawCalls;
  for (const TileCounts& tile : atlas.tiles) report.counts.casterTriangles += tile.casterTriangles;
  for (const auto& [samples, surfaces] : drawn.surfaces) {
    report.counts.shadedTriangles += surfaces.triangles;
    report.counts.drawCalls += surfaces.drawCalls;
  }
  report.counts.drawCalls += drawn.casters.drawCalls + drawn.views.size();
  report.stages = std::move(stages);
  report.warnings = frame.warnings;
  return report;
}

} // namespace gnomon
