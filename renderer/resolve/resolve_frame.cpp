#include "renderer/resolve/resolve_frame.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "protocol/base/text.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/settled_sun.h"
#include "renderer/core/collect.h"
#include "renderer/resolve/check_frame.h"
#include "renderer/resolve/framing.h"
#include "renderer/resolve/resolve_camera.h"
#include "renderer/resolve/resolve_debug.h"
#include "renderer/resolve/resolve_nodes.h"

namespace gnomon {
namespace {

/// Of the suns by place and time that have set.
void appendNightWarnings(const FrameSpec& asked, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; asked.lights && i < asked.lights->size(); ++i) {
    const auto& sun = (*asked.lights)[i].sun;
    if (!sun || !isNight(*sun)) continue;
    warnings.push_back("Light " + std::to_string(i) + " gives no light: at its place and time the sun is " +
                       std::to_string(std::llround(-*settledSun(*sun).elevationDegrees)) +
                       " degrees below the horizon.");
  }
}

std::string namesOf(const std::vector<std::string>& variants) {
  if (variants.empty()) return "the file has no material variants";
  return oneOf(std::vector<std::string_view>(variants.begin(), variants.end()));
}

/// Index into Scene::variants; of two of one name the first.
Result<int> resolveVariant(const std::string& name, const Scene& scene) {
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), name);
  if (found != scene.variants.end()) return static_cast<int>(found - scene.variants.begin());
  return Problem{ProblemCode::invalidValue, "/materialVariant", "The file has no material variant of that name.",
                 namesOf(scene.variants), name};
}

/// Why the scene does not have the camera that is asked for, where its file has one.
Problems whyWithout(Problems problems, const Camera& camera, const Scene& scene) {
  for (const LeftOutCamera& each : scene.leftOutCameras) {
    const auto* asked = camera.node ? std::get_if<std::string>(&*camera.node) : nullptr;
    if (asked && (*asked == each.name || *asked == "node:" + std::to_string(each.node))) {
      problems.front().detail = "The camera of that node is left out, since the file has a fault: " + each.why;
    }
  }
  return problems;
}

} // namespace

std::vector<Light> lightsOf(const SceneView& scene) {
  std::vector<Light> lights;
  for (const SceneLight& light : scene.lights) lights.push_back(light.light);
  return lights;
}

int resolveScene(const FrameSpec& spec, const Scene& scene, ProblemList& problems) {
  const int index = spec.scene.value_or(scene.defaultScene);
  const int count = fileScenes(scene);
  const bool isThere = index >= 0 && index < count;
  if (!isThere) {
    problems.add({ProblemCode::invalidValue, "/scene", "The file has no scene of that index.",
                  "0.." + std::to_string(count - 1), std::to_string(index)});
  }
  if (!spec.materialVariant) return isThere ? index : -1;
  const auto variant = collect(resolveVariant(*spec.materialVariant, scene), problems);
  return isThere ? indexOf(scene, {index, variant}) : -1;
}

ResolvedFrame resolveFrame(const Scene& scene, const FrameSpec& spec, ProblemList& problems,
                           std::span<const Light> ofEnvironment) {
  if (spec.quality) {
    problems.add({ProblemCode::invalidValue, "/quality",
                  "This call does not support quality targets; give settings instead.", "", ""});
  }
  ResolvedFrame frame{spec, {}, resolveScene(spec, scene, problems), {}, {}, {}, {}, {}};
  auto nodes = collect(resolveNodes(spec.nodes, scene), problems);
  if (nodes) frame.nodes = *std::move(nodes);
  const SceneView none;
  const SceneView& view = frame.scene < 0 ? none : scene.scenes[static_cast<std::size_t>(frame.scene)];
  frame.spec.lights = lightsOf(spec, lightsOf(view), ofEnvironment);
  const std::size_t own = frame.spec.lights->size() - ofEnvironment.size();
  if (!spec.lights && view.lights.size() > own) {
    frame.warnings.push_back("The scene has " + std::to_string(view.lights.size()) + " lights; only the first " +
                             std::to_string(own) + " light this frame.");
  }
  if (!ofEnvironment.empty()) {
    frame.spec.environment.extractSun = SunExtraction::removed; // asked for again, it would be there twice
    const auto most = static_cast<std::size_t>(kLimits.maxLights);
    if (frame.spec.lights->size() > most) {
      problems.add({ProblemCode::tooLarge, "/lights", "With the sun of the environment there are too many lights.",
                    std::to_string(most), std::to_string(frame.spec.lights->size())});
    }
  }
  appendNightWarnings(spec, frame.warnings);
  if (frame.spec.environment.sky) frame.spec.environment.sky->sun = settledSun(frame.spec.environment.sky->sun);
  if (frame.scene < 0) return frame;
  frame.spec.scene = spec.scene.value_or(scene.defaultScene);
  if (scene.ground && frame.spec.ground) {
    frame.spec.ground->height = scene.ground->center.y;
    frame.spec.ground->size = scene.ground->size;
  }

  SeenExtent seen(scene, view, frame.nodes);
  // What is hidden altogether is framed as if it were there.
  const FramedSubject subject =
      seen.empty() ? subjectOf(view.bounds)
                   : subjectOf(seen.bounds(), [&](const glm::dvec3& way) { return seen.farthest(way); });
  if (auto camera = resolveCamera(spec.camera, view, {spec.width, spec.height}, subject)) {
    frame.spec.camera = camera->camera;
    frame.view = movedToScene(camera->view, view, receivingInstances(scene, view, frame.nodes));
  } else {
    collect(whyWithout(camera.problems(), spec.camera, scene), problems);
  }
  collect(checkDebugLight(spec.debug, frame.spec.lights->size()), problems);
  if (auto volumes = collect(resolveVolumes(spec.volumes, scene, view, frame.nodes), problems)) {
    frame.volumes = *std::move(volumes);
  }
  if (!nodes) return frame; // what follows depends on what they switch
  frame.layers = layersInUse(scene, view, frame.nodes);
  if (auto groups = collect(resolveReceiverGroups(scene, view, frame.nodes, *frame.spec.lights), problems)) {
    frame.groups = *std::move(groups);
  }
  collect(checkTechniques(spec, scene, frame), problems);
  return frame;
}

Result<ResolvedFrame> resolveFrame(const Scene& scene, const FrameSpec& spec) {
  ProblemList problems;
  ResolvedFrame frame = resolveFrame(scene, spec, problems);
  if (!problems.empty()) return std::move(problems).take();
  return frame;
}

} // namespace gnomon
