#include "renderer/frame/frame.h"
#include "renderer/frame/frame_warnings.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/prepare/box_depths.h"
#include "renderer/prepare/cluster_choice.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_debug.h"

namespace gnomon {
namespace {

/// Of lights that `other` does not plan.
void addCasters(const ShadowPlan& plan, const ResolvedFrame& frame, const Scene& scene, const FrameGeometry& geometry,
                std::vector<LightReport>& lights, const ShadowPlan& other = {}) {
  const SceneView& view = scene.scenes[static_cast<std::size_t>(frame.scene)];
  for (const PlannedLight& planned : plan.lights) {
    if (isPlanned(other, planned.light)) continue;
    LightReport& light = lights[static_cast<std::size_t>(planned.light)];
    for (std::size_t i = 0; i < light.tiles.size(); ++i) {
      const ShadowTile& tile = plan.tiles[static_cast<std::size_t>(planned.firstTile) + i];
      if (tile.rect.width == 0) continue;
      const Light& caster = (*frame.spec.lights)[static_cast<std::size_t>(planned.light)];
      const TileCasters casters = castersInto(tile, caster, view, geometry, frame.nodes);
      const DrawList draws = buildDrawList(scene, view, geometry, casters.use, casters.slots);
      light.tiles[i].casterTriangles = draws.triangles;
      light.tiles[i].culledTriangles = view.triangles - draws.triangles;
      light.tiles[i].drawCalls = draws.ranges.size();
    }
    addSums(light);
  }
}

/// What a survey may find at most.
SeenDepths boxesSeen(const ResolvedFrame& frame, const SceneView& view, const FrameGeometry& geometry) {
  std::vector<std::uint8_t> visible(geometry.slotCount(), 1);
  keepNodes(
      frame.nodes, view, geometry, [](const NodeSwitches& node) { return node.visible; }, visible);
  const auto depthsOf = [&](std::span<const std::uint8_t> slots) {
    return boxDepths(frame.view, frame.spec.width, frame.spec.height, geometry.slotBounds, slots);
  };
  SeenDepths seen{depthsOf(visible), {}};
  for (const std::uint32_t groups : receiverParts(frame)) {
    seen.parts.push_back(depthsOf(slotsOfGroups(geometry, groups, visible)));
  }
  return seen;
}

} // namespace

Result<PlanReport> planFrame(const ScenePtr& loaded, const FrameSpec& spec, const RendererInfo& device) {
  const auto settled = settleFrame(loaded, spec, &device);
  if (!settled) return settled.problems();
  const ResolvedFrame& frame = settled->frame;
  const Scene& scene = *settled->scene;
  const SceneView& view = settled->view();
  const FrameGeometry geometry = frameGeometry(scene, view, frame.view.eye, frame.groups.ofInstance);
  const FramePlans plans = framePlans(frame, view, boxesSeen(frame, view, geometry), device.maxTextureSize);
  const PlanInput& input = plans.input;
  const ShadowPlan& plan = plans.drawn;
  if (const auto fits = settlePlan(frame.spec, plan, settled->layered); !fits) return fits.problems();
  const PredictedErrors errors = predictErrors(input, plan);

  PlanReport report;
  report.spec = frame.spec;
  report.depthRange = askedDepths(frame.view, input.receivers.range);
  report.atlasSize = {plan.atlasWidth, plan.atlasHeight};
  report.lights = lightReports(frame, plans, errors, settled->layered, predictErrors(plans.wholeInput, plans.whole));
  addCasters(plan, frame, scene, geometry, report.lights);
  addCasters(plans.whole, frame, scene, geometry, report.lights, plan);
  report.environment = settled->environment.report;
  report.predictedError = errors.all;
  report.warnings = loaded->summary.warnings;
  report.warnings.insert(report.warnings.end(), frame.warnings.begin(), frame.warnings.end());
  for (std::string& warning :
       frameWarnings({scene, view, frame, input.receivers, plan, errors, settled->layered}, WarnedBy::plan)) {
    report.warnings.push_back(std::move(warning));
  }
  return report;
}

} // namespace gnomon
