#include "renderer/frame/settle_frame.h"

#include <algorithm>

#include "protocol/spec/traits.h"
#include "renderer/core/collect.h"
#include "renderer/core/visibility_limit.h"
#include "renderer/frame/check_baked.h"
#include "renderer/frame/volumes_of_frame.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

template <class Is>
bool showsAny(const FrameSpec& spec, const Is& is) {
  return std::any_of(spec.views.begin(), spec.views.end(), is);
}

/// What rays and shadow volumes decide takes no more memory than a frame may have.
Status checkLayers(const ResolvedFrame& frame, const std::vector<int>& layered) {
  const FrameSpec& spec = frame.spec;
  const bool inPicture =
      showsAny(spec, [](View view) { return traitsOf(view).shadowed && traitsOf(view).source == ViewSource::picture; });
  const bool anywhere = spec.debug.predictEdges || showsAny(spec, [](View view) {
                          return traitsOf(view).shadowed || traitsOf(view).source == ViewSource::rays;
                        });
  const bool averaged = inPicture && spec.antialiasing == Antialiasing::msaa4x;
  const auto lights =
      std::count_if(layered.begin(), layered.end(), [&](int light) { return !techniqueOf(frame, light).baked; });
  return checkVisibilityBytes(spec.width, spec.height, averaged ? 4 : 1,
                              anywhere ? static_cast<std::size_t>(lights) : 0);
}

} // namespace

Result<SettledFrame> settleFrame(const ScenePtr& loaded, const FrameSpec& spec, const RendererInfo* device) {
  ProblemList problems;
  const auto posed = collect(posedScene(loaded, poseOf(spec)), problems);
  SettledFrame settled{loaded, posed.value_or(loaded), {}, {}, {}, {}};
  ResolvedFrame& frame = settled.frame;
  frame = resolveFrame(*settled.scene, spec, problems);
  if (device != nullptr) {
    collect(checkDevice(spec, *device), problems);
    frame.spec.device = device->device;
  }
  settled.layered = layeredLights(frame);
  settled.mapped = mappedLights(frame);
  if (showsAny(spec, [](View view) { return view == View::motion; })) {
    const SceneView none;
    const SceneView& view = frame.scene < 0 ? none : settled.view();
    settled.earlier = collect(earlierMoment(loaded, spec, frame.spec.camera, view), problems);
  }
  if (posed && frame.scene >= 0) collect(checkBaked(loaded, *posed, spec, frame), problems);
  collect(checkVolumes(*loaded, frame), problems);
  collect(checkLayers(frame, settled.layered), problems);
  if (!problems.empty()) return std::move(problems).take();
  if (settled.earlier) frame.spec.motionFrom->camera = settled.earlier->settledCamera;
  return settled;
}

} // namespace gnomon
