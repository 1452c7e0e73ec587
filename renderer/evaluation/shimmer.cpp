#include "renderer/evaluation/shimmer.h"

#include <algorithm>

#include "protocol/spec/traits.h"
#include "renderer/evaluation/evaluation_measures.h"
#include "renderer/evaluation/world_points.h"
#include "renderer/frame/settle_frame.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

constexpr int kPoints = 4096; // places of the first camera's picture

/// The points of a light, and what the last frame said of them.
struct Watched {
  int light = 0;
  std::vector<SurfacePoint> points;
  std::vector<std::uint8_t> lit; ///< S >= 0.5, one a point; empty before the first frame
};

/// A scene along a path of cameras.
struct SettledPath {
  ScenePtr scene; ///< posed
  std::vector<ResolvedFrame> frames;
};

Result<SettledPath> settlePath(const ScenePtr& scene, FrameSpec spec, std::span<const Camera> path,
                               const RendererInfo& device) {
  spec.camera = path.front();
  auto first = settleFrame(scene, spec, &device);
  if (!first) return first.problems();
  SettledPath settled{std::move(first->scene), {std::move(first->frame)}};
  for (const Camera& camera : path.subspan(1)) {
    spec.camera = camera;
    auto frame = resolveFrame(*settled.scene, spec);
    if (!frame) return frame.problems();
    for (std::size_t i = 0; i < frame->spec.lights->size(); ++i) {
      (*frame->spec.lights)[i].shadow->technique = (*settled.frames.front().spec.lights)[i].shadow->technique;
    }
    settled.frames.push_back(std::move(*frame));
  }
  return settled;
}

TraceInput traceInput(const TracedScene& traced, const ResolvedFrame& frame) {
  return {traced, frame.view, frame.spec.width, frame.spec.height, *frame.spec.lights, frame.nodes};
}

/// Shadows of full strength: a flip is one of visibility. Lights that are not measured keep their tiles, as in the
/// frame that was asked for.
void raiseStrengths(ResolvedFrame& frame) {
  for (Light& light : *frame.spec.lights) light.shadow->strength = 1;
}

/// Every measured light's points: seen by all cameras, the same places of the world for all of them.
Result<std::vector<Watched>> watchedPoints(const TracedScene& traced, const std::vector<ResolvedFrame>& frames) {
  const TraceInput first = traceInput(traced, frames.front());
  std::vector<SurfacePoint> seen = spreadPoints(first, kPoints);
  for (std::size_t i = 1; i < frames.size(); ++i) keepInSight(traceInput(traced, frames[i]), seen);

  std::vector<Watched> watched;
  const std::vector<int> casting = measuredLights(frames.front());
  for (const int light : casting) {
    std::vector<SurfacePoint> points = receiversOf(first, light, seen);
    for (SurfacePoint& point : points) point = shadedPoint(first, light, point);
    if (!points.empty()) watched.push_back({light, std::move(points), {}});
  }
  if (!watched.empty()) return watched;
  return Problem{ProblemCode::invalidValue, "/path",
                 casting.empty() ? "No light of this frame casts a shadow."
                                 : "No surface that faces a light is in sight of every camera of the path."};
}

std::vector<ProbePoint> probesOf(const ResolvedFrame& frame, const glm::dvec3& anchor, const Watched& watched) {
  std::vector<ProbePoint> probes;
  probes.reserve(watched.points.size());
  const bool grouped = !frame.groups.ofInstance.empty();
  for (const SurfacePoint& point : watched.points) {
    const std::uint8_t group = grouped ? frame.groups.ofInstance[point.instance] : std::uint8_t{0};
    probes.push_back({point.position + (anchor - frame.view.eye), glm::dvec3(point.normal), group});
  }
  return probes;
}

/// Counts the points that changed since the last frame.
std::uint64_t flipsOf(Watched& watched, const std::vector<float>& visibility) {
  std::vector<std::uint8_t> lit(visibility.size());
  std::transform(visibility.begin(), visibility.end(), lit.begin(), [](float s) { return s >= 0.5f ? 1 : 0; });
  std::uint64_t flips = 0;
  for (std::size_t i = 0; i < watched.lit.size(); ++i) flips += watched.lit[i] != lit[i] ? 1 : 0;
  watched.lit = std::move(lit);
  return flips;
}

bool isExact(const Light& light) {
  return traitsOf(light.shadow->technique).layered;
}

/// Lights whose shadows come from no map need no tiles.
void dropExact(FrameSpec& spec) {
  for (Light& light : *spec.lights) light.shadow->enabled = light.shadow->enabled && !isExact(light);
}

/// The next frame of a sequence starts from this one's depth ranges, where it asks for a previous one.
void passRangesOn(const ShadowPlan& plan, FrameSpec& next) {
  for (const PlannedLight& planned : plan.lights) {
    DepthRange& range = (*next.lights)[static_cast<std::size_t>(planned.light)].shadow->depthRange;
    if (range.previous && planned.depthRange) range.previous = {planned.depthRange->near, planned.depthRange->far};
  }
}

struct ProbedFrame {
  std::uint64_t flips = 0;
  ShadowPlan plan;
};

/// Casts a frame's shadows and asks every point for its light.
Result<ProbedFrame> probeFrame(Device& device, const ScenePtr& scene, const ResolvedFrame& frame,
                               std::vector<Watched>& watched) {
  const SceneView& view = scene->scenes[static_cast<std::size_t>(frame.scene)];
  const FrameSpec& spec = frame.spec;
  const auto begun = device.begin(
      {.scene = scene, .frame = frame, .layered = {}, .traced = {}, .baked = {}, .parts = receiverParts(frame)});
  if (!begun) return begun.problems();
  FrameDrawing& drawing = **begun;
  auto seen = drawing.survey();
  if (!seen) return seen.problems();
  ProbedFrame probed;
  probed.plan = framePlans(frame, view, *std::move(seen), device.info().maxTextureSize).drawn;
  if (const Status fits = checkAtlas(probed.plan, spec.atlas.samples); !fits) return fits.problems();
  const auto lights = litLights(*spec.lights, probed.plan, frame.view.eye, frame.groups.ofLight);
  const ShowInput nothing{.plan = probed.plan, .lights = lights};
  if (const Status cast = drawing.cast(nothing, TileUse::kept); !cast) return cast.problems();
  for (Watched& light : watched) {
    const auto visibility = drawing.probe({.plan = probed.plan, .lights = lights, .debugLight = light.light},
                                          probesOf(frame, anchorOf(view), light));
    if (!visibility) return visibility.problems();
    probed.flips += flipsOf(light, *visibility);
  }
  if (const auto done = drawing.finish(); !done) return done.problems();
  return probed;
}

} // namespace

Result<Shimmer> measureShimmer(Device& device, TracedSceneCache& tracedScenes, const ScenePtr& loaded,
                               const FrameSpec& spec, std::span<const Camera> path, const Progress& progress) {
  if (path.size() < 2) {
    return Problem{ProblemCode::invalidValue, "/path", "A path needs two cameras or more.", "at least 2",
                   std::to_string(path.size())};
  }
  auto settled = settlePath(loaded, spec, path, device.info());
  if (!settled) return settled.problems();
  const ScenePtr& scene = settled->scene;
  std::vector<ResolvedFrame>& frames = settled->frames;
  const auto traced = tracedScenes.get(scene, frames.front().scene);
  if (!traced) return traced.problems();
  auto watched = watchedPoints(**traced, frames);
  if (!watched) return watched.problems();
  for (ResolvedFrame& frame : frames) raiseStrengths(frame);

  Shimmer shimmer;
  shimmer.steps = path.size() - 1;
  for (const Watched& light : *watched) shimmer.points += light.points.size();
  // An exact shadow depends on the point alone, not on the camera: it never flips.
  std::erase_if(*watched, [&](const Watched& light) {
    return isExact((*frames.front().spec.lights)[static_cast<std::size_t>(light.light)]);
  });
  if (watched->empty()) return shimmer;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    dropExact(frames[i].spec);
    if (progress && !progress(static_cast<double>(i) / static_cast<double>(frames.size()))) {
      return Problem{ProblemCode::unavailable, "", "The measurement was stopped."};
    }
    const auto probed = probeFrame(device, scene, frames[i], *watched);
    if (!probed) return probed.problems();
    shimmer.flips += probed->flips;
    if (i + 1 < frames.size()) passRangesOn(probed->plan, frames[i + 1].spec);
  }
  return shimmer;
}

} // namespace gnomon
