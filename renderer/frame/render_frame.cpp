#include "renderer/frame/render_frame.h"

#include <algorithm>
#include <iterator>

#include "renderer/core/stop.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/frame/environment_of_frame.h"
#include "renderer/frame/frame_views.h"
#include "renderer/frame/frame_warnings.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/predicted_displacement.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/frame/volumes_of_frame.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_debug.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {
namespace {

Result<Frame> drawnFrame(Device& device, FrameCaches& caches, const ScenePtr& loaded, const FrameSpec& spec,
                         TileUse tiles) {
  auto settled = settleFrame(loaded, spec, &device.info());
  if (!settled) return settled.problems();
  const ScenePtr& scene = settled->scene;
  const ResolvedFrame& resolved = settled->frame;
  const FrameSpec& effective = resolved.spec;
  const SceneView& view = settled->view();
  const std::vector<int>& layered = settled->layered;
  const auto tracedScene = [&] { return caches.traced.get(scene, resolved.scene); };

  std::vector<LightMapCache::Found> baked;
  const auto bakedLight = [&](int light) { return baked[static_cast<std::size_t>(light)].baked; };

  MadeVolumes made;
  FrameEnvironment environment;
  const auto begun = device.begin({scene, resolved, layered, needsEdges(resolved), tracedScene, bakedLight,
                                   &made.volumes, &environment, receiverParts(resolved)});
  if (!begun) return begun.problems();
  FrameDrawing& drawing = **begun;

  auto found = bakedLights(caches.lightMaps, caches.traced, *settled, spec);
  if (!found) return found.problems();
  baked = *std::move(found);
  if (!baked.empty()) drawing.endStage("bake");

  auto around = environmentOf(caches.environments, *settled);
  if (!around) return around.problems();
  environment = *std::move(around);
  if (environment.environment) drawing.endStage("environment");

  auto volumes = volumesOf(caches.volumes, caches.traced, *settled, environment);
  if (!volumes) return volumes.problems();
  made = *std::move(volumes);
  if (!made.volumes.empty()) drawing.endStage("volume");

  auto seen = drawing.survey();
  if (!seen) return seen.problems();
  drawing.endStage("survey");

  const FramePlans plans = framePlans(resolved, view, *std::move(seen), device.info().maxTextureSize);
  const PlanInput& planned = plans.input;
  const ShadowPlan& plan = plans.drawn;
  const auto subject = settlePlan(effective, plan, layered);
  if (!subject) return subject.problems();
  PredictedErrors errors = predictErrors(planned, plan);
  const auto lights = litLights(*effective.lights, plan, resolved.view.eye, resolved.groups.ofLight, layered);
  const auto lists = lights.size() > kLightsWithoutLists ? lightLists(resolved.view, planned.receivers, lights)
                                                         : std::vector<std::uint32_t>{};
  const bool layerDecides = std::find(layered.begin(), layered.end(), subject->light) != layered.end();
  const FrameViews views(effective, layerDecides);
  std::vector<std::string> warnings =
      frameWarnings({*scene, view, resolved, planned.receivers, plan, errors, layered}, WarnedBy::drawing, baked);
  const ShowInput show{plan, lights, lists, subject->light, subject->planned, subject->tile, views.requests()};
  drawing.endStage("plan");

  if (const Status cast = drawing.cast(show, tiles); !cast) return cast.problems();
  drawing.endStage("shadow");

  if (const Status shown = drawing.show(show); !shown) return shown.problems();
  drawing.endStage("shade");

  std::optional<PredictedError>* predicted = subject->planned != nullptr ? &errors.lights[subject->index] : nullptr;
  if (effective.debug.predictEdges && readsMap(lights, subject->light)) {
    const auto footprints = drawing.footprints(show);
    if (!footprints) return footprints.problems();
    const auto displacement =
        displacementOf(resolved.view, effective, plan, *subject->planned, *footprints, views.fullShadow(drawing));
    if (displacement && *predicted) {
      (*predicted)->edgeDisplacement = displacement->mean;
      (*predicted)->edgeLength = displacement->length;
    }
    if (displacement) drawing.endStage("predict");
  }

  std::optional<MeasuredShadow> measured;
  if (views.needReference()) {
    const auto rays = tracedScene();
    if (!rays) return rays.problems();
    const std::vector<const Medium*> media = made.volumes.all();
    auto compared = measureShadow(resolved, **rays, subject->light, {environment, media}, views.fullShadow(drawing));
    if (!compared) return compared.problems();
    measured = std::move(*compared);
    if (predicted != nullptr) measured->errors.predicted = *predicted;
    drawing.endStage("reference");
  }

  std::optional<ShownGeometry> geometry;
  if (views.needGeometry()) {
    auto triangles = drawing.shownTriangles();
    if (!triangles) return triangles.problems();
    geometry.emplace(ShownGeometry{*scene, view, resolved.view, effective.width, effective.height,
                                   *std::move(triangles), settled->earlier ? &*settled->earlier : nullptr});
  }

  std::vector<int> casters;
  if (views.needCasters()) {
    const auto rays = tracedScene();
    if (!rays) return rays.problems();
    const TraceInput input{**rays, resolved.view, effective.width, effective.height, *effective.lights, resolved.nodes};
    casters = casterNodes(*geometry, input, subject->light);
  }

  std::optional<ShownSunHours> sunHours;
  if (views.needSunHours()) {
    const auto rays = tracedScene();
    if (!rays) return rays.problems();
    const TraceInput input{**rays, resolved.view, effective.width, effective.height, *effective.lights, resolved.nodes};
    sunHours = sunHoursOf(*geometry, input, *effective.sunHours);
    drawing.endStage("sunHours");
  }

  auto images = views.images(drawing, measured ? &*measured : nullptr, geometry ? &*geometry : nullptr, casters,
                             sunHours ? &*sunHours : nullptr);
  drawing.endStage("readback");
  auto facts = drawing.finish();
  if (!facts) return facts.problems();
  const auto error = measured ? std::optional(measured->errors) : std::nullopt;
  FrameReport report = makeReport({resolved, view.triangles, planned.receivers.range, plans, errors, layered, baked,
                                   made.reports, *std::move(facts), error});
  const auto warn = [&](std::vector<std::string> more) {
    std::move(more.begin(), more.end(), std::back_inserter(report.warnings));
  };
  if (sunHours) report.sunHours = sunHours->report;
  report.environment = settled->environment.report;
  report.warnings.insert(report.warnings.begin(), loaded->summary.warnings.begin(), loaded->summary.warnings.end());
  warn(damageOf(scene->images));
  warn(std::move(warnings));
  return Frame{std::move(report), std::move(images)};
}

} // namespace

Result<Frame> renderFrame(Device& device, FrameCaches& caches, const ScenePtr& scene, const FrameSpec& spec,
                          TileUse tiles, const GoOn& goOn) {
  return untilStopped(goOn, [&] { return drawnFrame(device, caches, scene, spec, tiles); });
}

} // namespace gnomon
