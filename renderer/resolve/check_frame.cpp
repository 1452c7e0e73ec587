#include "renderer/resolve/check_frame.h"

#include <algorithm>
#include <utility>

#include "protocol/base/result.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {

std::string shadowPlace(const FrameSpec& asked, int light) {
  const auto index = static_cast<std::size_t>(light); // the environment's sun comes after those that were asked for
  const bool own = asked.lights && index < asked.lights->size() && (*asked.lights)[index].shadow;
  return own ? "/lights/" + std::to_string(light) + "/shadow" : "/shadow";
}

Status checkDevice(const FrameSpec& spec, const RendererInfo& device) {
  ProblemList problems;
  for (const auto& [side, place] : {std::pair(spec.width, "/width"), std::pair(spec.height, "/height")}) {
    if (side <= device.maxTextureSize) continue;
    problems.add({ProblemCode::invalidValue, place, "The device has no pictures as large as that.",
                  "at most " + std::to_string(device.maxTextureSize), std::to_string(side)});
  }
  if (spec.atlas.samples > device.maxSamples) {
    problems.add({ProblemCode::invalidValue, "/atlas/samples", "The device has no depth textures of so many samples.",
                  "at most " + std::to_string(device.maxSamples), std::to_string(spec.atlas.samples)});
  }
  if (spec.atlas.size > device.maxTextureSize) {
    problems.add({ProblemCode::invalidValue, "/atlas/size", "The device has no textures as large as that.",
                  "at most " + std::to_string(device.maxTextureSize), std::to_string(spec.atlas.size)});
  }
  if (device.device == DeviceChoice::cpu) {
    for (const std::string& place : placesOfShadowVolumes(spec)) {
      problems.add({ProblemCode::unsupportedFeature, place,
                    "The device cpu draws no shadow volumes (technique shadowVolume): choose another technique, as "
                    "rayTraced, or draw by OpenGL, started with --device gl.",
                    "shadowMap, rayTraced or lightMap", "shadowVolume"});
    }
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

Status checkAtlas(const ShadowPlan& plan, int samples) {
  constexpr std::int64_t kDepthBytes = 4;
  constexpr std::int64_t kMomentBytes = 16;
  const bool moments = std::any_of(plan.tiles.begin(), plan.tiles.end(), isBlurred);
  const std::int64_t texels = std::int64_t{plan.atlasWidth} * plan.atlasHeight;
  const std::int64_t bytes = texels * (kDepthBytes * samples + (moments ? kMomentBytes : 0));
  if (bytes <= kLimits.maxAtlasBytes) return Done{};
  return Problem{ProblemCode::tooLarge, "/atlas/size",
                 "The shadow atlas would take more memory than a frame may have; samples and moments count.",
                 std::to_string(kLimits.maxAtlasBytes) + " bytes", std::to_string(bytes) + " bytes"};
}

namespace {

std::string quotedName(const std::string& name, int index) {
  return name.empty() ? std::to_string(index) : "\"" + name + "\"";
}

/// The first caster of a light that lets some of it through; null = there is none.
const Instance* firstThatLightPasses(const Scene& scene, const ResolvedFrame& frame, const Light& light) {
  const std::vector<Instance>& instances = scene.scenes[static_cast<std::size_t>(frame.scene)].instances;
  const auto found = std::find_if(instances.begin(), instances.end(), [&](const Instance& instance) {
    const NodeSwitches node =
        frame.nodes.empty() ? NodeSwitches{} : frame.nodes[static_cast<std::size_t>(instance.node)];
    return castsFrom(light, node) &&
           !stopsAllLight(scene.materials[static_cast<std::size_t>(materialOf(scene, instance))]);
  });
  return found == instances.end() ? nullptr : &*found;
}

} // namespace

Status checkTechniques(const FrameSpec& asked, const Scene& scene, const ResolvedFrame& frame) {
  ProblemList problems;
  std::string last;
  for (const int index : shadowingLights(frame)) {
    const Light& settled = (*frame.spec.lights)[static_cast<std::size_t>(index)];
    const std::string pointer = shadowPlace(asked, index) + "/technique";
    if (!traitsOf(settled.shadow->technique).needsOpaqueCasters || pointer == last) continue;
    const Instance* instance = firstThatLightPasses(scene, frame, settled);
    if (instance == nullptr) continue;
    const int material = materialOf(scene, *instance);
    problems.add({ProblemCode::unsupportedFeature, pointer,
                  "Technique " + std::string(spell(settled.shadow->technique)) + " does not support alpha: node " +
                      quotedName(scene.nodes[static_cast<std::size_t>(instance->node)].name, instance->node) +
                      " casts, and its material " +
                      quotedName(scene.materials[static_cast<std::size_t>(material)].name, material) +
                      " is masked, blended or lets light through.",
                  "opaque casters: turn the node's castShadow off, or choose another technique",
                  std::string(spell(settled.shadow->technique))});
    last = pointer;
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

} // namespace gnomon
