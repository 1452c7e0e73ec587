#include "renderer/render.h"

#include <algorithm>

#include "renderer/evaluation/shimmer.h"
#include "renderer/frame/draw_views.h"
#include "renderer/frame/error_views.h"
#include "renderer/frame/frame_data.h"
#include "renderer/frame/gpu_scene_cache.h"
#include "renderer/frame/make_report.h"
#include "renderer/frame/measured_shadow.h"
#include "renderer/frame/predicted_displacement.h"
#include "renderer/frame/read_views.h"
#include "renderer/frame/traced_scene_cache.h"
#include "renderer/gl/context.h"
#include "renderer/gl/debug_log.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/survey/survey_pass.h"
#include "renderer/passes/tiles/shadow_pass.h"
#include "renderer/passes/views/light_data.h"
#include "renderer/passes/views/light_lists.h"
#include "renderer/resolve/check_device.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_debug.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/gltf_loader.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {

Result<ScenePtr> loadScene(const SceneBundle& bundle, const Limits& limits) {
  return loadGltf(bundle, limits);
}

const SceneSummary& summaryOf(const Scene& scene) {
  return scene.summary;
}

/// The context comes first, so that it outlives everything made in it.
struct Renderer::Impl {
  std::unique_ptr<gl::Context> context;
  ProgramCache programs;
  GpuSceneCache scenes;
  TileCache tiles;
  TracedSceneCache traced;
  HybridMaps hybridMaps;
};

namespace {

/// Hybrid maps know where casters end, and shadow volumes rise from there.
bool asksForEdges(const FrameSpec& spec, std::span<const int> mapped) {
  const auto technique = [&](int light) { return (*spec.lights)[static_cast<std::size_t>(light)].shadow->technique; };
  return std::any_of(mapped.begin(), mapped.end(), [&](int l) { return technique(l) == ShadowTechnique::hybrid; }) ||
         std::any_of(spec.lights->begin(), spec.lights->end(),
                     [](const Light& light) { return light.shadow->technique == ShadowTechnique::shadowVolume; });
}

} // namespace

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const RendererOptions& options) {
  auto context = gl::createContext(options.backend);
  if (!context) return context.problems();
  return Renderer(std::unique_ptr<Impl>(new Impl{std::move(*context),
                                                 {},
                                                 GpuSceneCache(options.gpuSceneBytes),
                                                 TileCache(options.tileCacheBytes),
                                                 TracedSceneCache(options.tracedSceneBytes),
                                                 options.hybridMaps}));
}

const RendererInfo& Renderer::info() const {
  return impl_->context->info();
}

Result<Shimmer> Renderer::shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path,
                                  const Progress& progress) {
  return measureShimmer({impl_->scenes, impl_->programs, impl_->tiles, impl_->traced, info()}, scene, spec, path,
                        progress);
}

Result<Frame> Renderer::render(const ScenePtr& loaded, const FrameSpec& spec, TileUse tileUse) {
  const auto posed = posedScene(loaded, spec.animation);
  if (!posed) return posed.problems();
  const ScenePtr& scene = *posed;
  auto resolved = resolveFrame(*scene, spec);
  if (!resolved) return resolved.problems();
  if (const Status able = checkDevice(spec, info()); !able) return able.problems();
  const FrameSpec& effective = resolved->spec;
  const SceneView& view = scene->scenes[static_cast<std::size_t>(resolved->scene)];
  gl::StageClock clock;

  const GpuScene& gpu = impl_->scenes.get(scene);
  const FrameGeometry geometry = frameGeometry(*scene, view, resolved->view.eye, resolved->groups.ofInstance);
  const gl::Buffer instances(gl::bytesOf(geometry.instances), "instances");
  const SceneVertices vertices = sceneVertices(gpu, instances);
  const SceneVertices anchored = sceneVertices(gpu, gpu.anchored[static_cast<std::size_t>(resolved->scene)]);
  shared::FrameData data = frameData(*resolved);
  gl::Buffer frameBuffer(sizeof(data), "frame");
  frameBuffer.update(0, gl::bytesOfValue(data));
  const std::vector<int> layered = layeredLights(*resolved);
  const std::vector<int> mapped = mappedLights(*resolved, view, info(), impl_->hybridMaps);
  const PassInputs inputs{
      *scene,
      view,
      gpu,
      geometry,
      resolved->view,
      frameBuffer,
      instances,
      vertices,
      anchored,
      impl_->programs,
      effective.width,
      effective.height,
      resolved->nodes,
      asksForEdges(effective, mapped) ? std::span(impl_->scenes.edges(scene)) : std::span<const EdgeMesh>{},
      resolved->groups.matter()};
  clock.finish("upload");

  const int samples = effective.antialiasing == Antialiasing::msaa4x ? 4 : 1;
  const auto survey = surveyScene(inputs, samples);
  if (!survey) return survey.problems();
  clock.finish("survey");

  const ShadowPlan plan = planShadows(planInput(*resolved, view, survey->receivers, mapped, info().maxTextureSize));
  if (const Status fits = checkAtlas(plan, effective.atlas.samples); !fits) return fits.problems();
  PredictedErrors errors = predictErrors(resolved->view, survey->receivers, plan);
  const auto lights = lightData(*effective.lights, plan, resolved->view.eye, resolved->groups.ofLight, layered);
  const auto tiles = tileData(plan);
  const auto lists = lights.size() > kLightsWithoutLists ? lightLists(resolved->view, survey->receivers, lights)
                                                         : std::vector<std::uint32_t>{};
  if (!survey->receivers.range.empty()) {
    data.depthRange.x = survey->receivers.range.nearest;
    data.depthRange.y = survey->receivers.range.farthest;
    frameBuffer.update(0, gl::bytesOfValue(data));
  }
  const auto subject = debugSubject(effective, plan, layered);
  if (!subject) return subject.problems();
  clock.finish("plan");

  TileCache noTiles(0);
  const auto atlas = castShadows(inputs, plan, effective, tileUse == TileUse::kept ? impl_->tiles : noTiles);
  if (!atlas) return atlas.problems();
  clock.finishDrawing("shadow");

  const ExactInputs exact{layered, [&] { return impl_->traced.get(scene, resolved->scene); }};
  const ViewInputs shading{*survey, *atlas, lights, tiles, lists, effective, subject->light};
  const auto drawn = drawViews(inputs, shading, exact, plan, subject->planned);
  if (!drawn) return drawn.problems();
  clock.finishDrawing("shade");

  const auto displacement = predictDisplacement(inputs, shading, plan, *drawn);
  if (!displacement) return displacement.problems();
  if (*displacement) {
    auto& predicted = errors.lights[static_cast<std::size_t>(subject->planned - plan.lights.data())];
    if (predicted) {
      predicted->edgeDisplacement = (*displacement)->mean;
      predicted->edgeLength = (*displacement)->length;
    }
    clock.finish("predict");
  }

  std::optional<MeasuredShadow> measured;
  if (std::any_of(effective.views.begin(), effective.views.end(), isErrorView)) {
    auto traced = impl_->traced.get(scene, resolved->scene);
    if (!traced) return traced.problems();
    auto made = measureShadow(*resolved, **traced, subject->light, readFullShadow(*drawn));
    if (!made) return made.problems();
    measured = std::move(*made);
    if (subject->planned != nullptr) {
      measured->errors.predicted = errors.lights[static_cast<std::size_t>(subject->planned - plan.lights.data())];
    }
    clock.finish("reference");
  }

  auto images = readViews({effective, *drawn, *atlas, plan, subject->tile, measured ? &*measured : nullptr});
  clock.finish("readback");
  if (const Status clean = gl::checkErrors("rendering a frame"); !clean) return clean.problems();

  const auto error = measured ? std::optional(measured->errors) : std::nullopt;
  return Frame{makeReport({*resolved, view, gpu, *survey, plan, errors, *atlas, *drawn, error}, clock.take()),
               std::move(images)};
}

} // namespace gnomon
