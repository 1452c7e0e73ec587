#include "renderer/frame/settle_frame.h"

#include <algorithm>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/traits.h"
#include "renderer/core/collect.h"
#include "renderer/core/visibility_limit.h"
#include "renderer/frame/check_baked.h"
#include "renderer/frame/volumes_of_frame.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/choose_techniques.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

template <class Is>
bool showsAny(const FrameSpec& spec, const Is& is) {
  return std::any_of(spec.views.begin(), spec.views.end(), is);
}

/// Samples a pixel of visibility layers; 0 = no view shows a shadow.
std::size_t layerSamples(const FrameSpec& spec) {
  const bool anywhere = spec.debug.predictEdges || showsAny(spec, [](View view) {
                          return traitsOf(view).shadowed || traitsOf(view).source == ViewSource::rays;
                        });
  const bool inPicture =
      showsAny(spec, [](View view) { return traitsOf(view).shadowed && traitsOf(view).source == ViewSource::picture; });
  if (!anywhere) return 0;
  return inPicture ? static_cast<std::size_t>(samplesOf(spec.antialiasing)) : 1;
}

/// What rays and shadow volumes decide takes no more memory than a frame may have.
Status checkLayers(const ResolvedFrame& frame, const std::vector<int>& layered) {
  const auto lights =
      std::count_if(layered.begin(), layered.end(), [&](int light) { return !techniqueOf(frame, light).baked; });
  return checkVisibilityBytes(frame.spec.width, frame.spec.height, layerSamples(frame.spec),
                              static_cast<std::size_t>(lights));
}

/// Lights whose visibility the frame may keep.
std::size_t roomForLayers(const FrameSpec& spec) {
  const std::size_t samples = std::max<std::size_t>(layerSamples(spec), 1);
  return static_cast<std::size_t>(kLimits.maxVisibilityBytes / visibilityBytes(spec.width, spec.height, samples, 1));
}

} // namespace

Result<SettledFrame> settleFrame(const ScenePtr& loaded, const FrameSpec& spec, const RendererInfo* device) {
  ProblemList problems;
  const auto posed = collect(posedScene(loaded, poseOf(spec)), problems);
  SettledFrame settled{loaded, posed.value_or(loaded), {}, {}, {}};
  ResolvedFrame& frame = settled.frame;
  frame = resolveFrame(*settled.scene, spec, problems);
  if (device != nullptr) {
    collect(checkDevice(spec, *device), problems);
    frame.spec.device = device->device;
  }
  if (frame.scene >= 0) {
    const DeviceKind kind = device != nullptr ? kindOf(*device) : DeviceKind::processor;
    chooseTechniques(*settled.scene, kind, roomForLayers(frame.spec), frame);
  }
  settled.layered = layeredLights(frame);
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
