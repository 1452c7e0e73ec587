#include "renderer/frame/settle_frame.h"

#include <algorithm>
#include <span>

#include "protocol/spec/frame_lights.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/core/collect.h"
#include "renderer/frame/volume_cache.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/resolve_ground.h"
#include "renderer/scene/animation/posed_scene.h"

namespace gnomon {
namespace {

std::span<const glm::vec3> verticesOf(const Scene& scene, const Instance& instance) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  return std::span(scene.positions).subspan(primitive.baseVertex, primitive.vertexCount);
}

/// A node that an animation moves from its rest pose, hides, or whose mesh it deforms; -1 = there is none.
int movedNode(const Scene& without, const Scene& with, int index) {
  const std::vector<Instance>& still = without.scenes[static_cast<std::size_t>(index)].instances;
  const std::vector<Instance>& moved = with.scenes[static_cast<std::size_t>(index)].instances;
  const bool deformed = without.positions != with.positions;
  const auto same = [&](const Instance& a, const Instance& b) {
    if (a.node != b.node || a.primitive != b.primitive || a.copy != b.copy) return false;
    if (a.worldFromLocal != b.worldFromLocal || a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max) {
      return false;
    }
    return !deformed || std::ranges::equal(verticesOf(without, a), verticesOf(with, b));
  };
  const auto [a, b] = std::mismatch(still.begin(), still.end(), moved.begin(), moved.end(), same);
  if (b != moved.end()) return b->node;
  return a == still.end() ? -1 : a->node;
}

std::string nameOf(const Scene& scene, int node) {
  const std::string& name = scene.nodes[static_cast<std::size_t>(node)].name;
  return name.empty() ? std::to_string(node) : "\"" + name + "\"";
}

/// A problem for each light whose shadow a light map holds, where the pose moves something. `asked`: the spec before it
/// was settled, whose fields are pointed at.
Status checkBaked(const ScenePtr& loaded, const ScenePtr& posed, const FrameSpec& asked, const ResolvedFrame& frame) {
  const std::vector<int> lights = lightsToBake(frame);
  if (lights.empty()) return Done{};
  if (posed->ground) {
    return Problem{ProblemCode::unsupportedFeature, "/ground",
                   "Light maps hold no shadows of a ground, which is no part of the file.",
                   "another technique, or no ground", "lightMap"};
  }
  const auto still = posedScene(loaded, {.nodes = asked.nodes});
  if (!still) return still.problems();
  const int node = movedNode(**still, *posed, frame.scene);
  if (node < 0) return Done{};
  ProblemList problems;
  for (const int light : lights) {
    collect({{ProblemCode::unsupportedFeature, shadowPlace(asked, light) + "/technique",
              "A light map holds shadows of static nodes, but this pose moves node " + nameOf(*loaded, node) + ".",
              "another technique, or no animation", "lightMap"}},
            problems);
  }
  return std::move(problems).take();
}

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
  const std::size_t lights = layered.size() - lightsToBake(frame).size();
  return checkVisibilityBytes(frame.spec.width, frame.spec.height, layerSamples(frame.spec), lights);
}

/// Nor does what rays find of its environment: four shares at each sample, and as much again while it is found.
Status checkSkyLayers(const ResolvedFrame& frame, const std::vector<int>& layered) {
  const FrameSpec& spec = frame.spec;
  if (spec.environment.shadows == EnvironmentShadows::none) return Done{};
  const std::size_t lights = layered.size() - lightsToBake(frame).size();
  const std::size_t samples = layerSamples(spec);
  const std::int64_t sky = visibilityBytes(spec.width, spec.height, samples + 2, samples == 0 ? 0 : 4);
  return checkVisibilityBytes(
      sky + visibilityBytes(spec.width, spec.height, samples, lights), "/environment/shadows",
      "Shadows of an environment and of lights take too much memory in a picture of this size.");
}

/// Lights whose visibility the frame may keep.
std::size_t roomForLayers(const FrameSpec& spec) {
  const std::size_t samples = std::max<std::size_t>(layerSamples(spec), 1);
  return static_cast<std::size_t>(kLimits.maxVisibilityBytes / visibilityBytes(spec.width, spec.height, samples, 1));
}

/// What devices keep of volumes for each pixel takes no more than a frame may have.
Status checkVolumePixels(const FrameSpec& spec) {
  const std::int64_t samples = samplesOf(spec.antialiasing);
  const std::int64_t pixel = sizeof(glm::vec4) + samples * (sizeof(float) + sizeof(std::uint16_t));
  const std::int64_t bytes = pixel * spec.width * spec.height;
  return checkVisibilityBytes(bytes, "/volumes", "A picture of this size takes too much memory with volumes.");
}

/// Every problem of a frame's volumes that is known without reading them: at /volumes where a file is missing, a place
/// is flat or the picture is too large, at /lights where there are more than may shine on volumes. `frame.volumes` may
/// be empty, where their nodes were refused.
Status checkVolumes(const Scene& loaded, const ResolvedFrame& frame) {
  const std::vector<VolumeOptions>& volumes = frame.spec.volumes;
  if (volumes.empty()) return Done{};
  ProblemList problems;
  const std::size_t lights = frame.spec.lights->size();
  if (lights > static_cast<std::size_t>(kLimits.maxVolumeLights)) {
    problems.add({ProblemCode::tooLarge, "/lights", "A frame with volumes has too many lights.",
                  std::to_string(kLimits.maxVolumeLights), std::to_string(lights)});
  }
  collect(checkVolumePixels(frame.spec), problems);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const std::string place = "/volumes/" + std::to_string(i);
    if (!loaded.grids.contains(volumes[i].file)) {
      problems.add({ProblemCode::invalidValue, place + "/file", "The upload has no .npy or .vdb file of that name.", "",
                    volumes[i].file});
    }
    if (i >= frame.volumes.size() || frame.volumes[i].hidden()) continue;
    if (const auto space = spaceOf(volumes[i], frame.volumes[i]); !space) {
      collect(placedAt(place, space.problems()), problems);
    }
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

} // namespace

Result<SettledFrame> settleFrame(const ScenePtr& loaded, const FrameSpec& asked, const RendererInfo* device) {
  FrameSpec spec = asked;
  spec.environment = sourcedEnvironment(*loaded, asked);
  ProblemList problems;
  const auto posed = collect(stagedScene(loaded, spec), problems);
  SettledFrame settled{loaded, posed.value_or(loaded), {}, {}, {}};
  if (auto environment = collect(settleEnvironment(*loaded, spec.environment), problems)) {
    settled.environment = *std::move(environment);
  }
  ResolvedFrame& frame = settled.frame;
  frame = resolveFrame(*settled.scene, spec, problems, settled.environment.lights);
  const auto& found = settled.environment.warnings;
  frame.warnings.insert(frame.warnings.end(), found.begin(), found.end());
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
    settled.earlier = collect(earlierMoment(loaded, spec, frame.spec.camera, view, settled.scene->ground), problems);
  }
  if (posed && frame.scene >= 0) collect(checkBaked(loaded, *posed, spec, frame), problems);
  collect(checkVolumes(*loaded, frame), problems);
  const Status layers = checkLayers(frame, settled.layered);
  collect(layers ? checkSkyLayers(frame, settled.layered) : layers, problems);
  if (!problems.empty()) return std::move(problems).take();
  if (settled.earlier) frame.spec.motionFrom->camera = settled.earlier->settledCamera;
  return settled;
}

} // namespace gnomon
