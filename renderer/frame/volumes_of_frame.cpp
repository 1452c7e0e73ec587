#include "renderer/frame/volumes_of_frame.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <type_traits>

#include "protocol/base/elapsed.h"
#include "protocol/spec/traits.h"
#include "renderer/core/collect.h"
#include "renderer/core/light.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/parallel.h"
#include "renderer/device/shader_data.h"
#include "renderer/frame/volume_sky.h"
#include "renderer/rays/trace.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/resolve/studio_radiance.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/shaders/shared/functions.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {
namespace {

constexpr std::size_t kPiece = 4096; // points that a core traces at a time

/// A text that differs where values do.
class Values {
 public:
  template <class T>
  Values& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Values& add(const std::string& text) {
    add(text.size());
    text_.append(text);
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void addPlace(const NodeOptions& entry, Values& text) {
  const auto addPart = [&](const auto& part) {
    text.add(part.has_value());
    if (part) text.add(*part);
  };
  if (!hasPlace(entry)) return;
  const int* index = std::get_if<int>(&*entry.node);
  text.add(index != nullptr ? *index : -1);
  if (index == nullptr) text.add(std::get<std::string>(*entry.node));
  addPart(entry.matrix);
  addPart(entry.translation);
  addPart(entry.rotation);
  addPart(entry.scale);
}

/// A frame's lights as they shine on volumes. Must not outlive the frame.
struct ShiningLights {
  std::vector<shared::LightData> data; ///< relative to `origin`
  glm::dvec3 origin{0};                ///< metres; a place near to what they shine on
  std::span<const Light> lights;
  std::vector<int> shadowing; ///< those whose shadows fall on volumes
};

double strengthOf(const ShiningLights& shining, std::size_t light) {
  const bool isShadowing = std::ranges::find(shining.shadowing, static_cast<int>(light)) != shining.shadowing.end();
  return isShadowing ? shining.lights[light].shadow->strength : 0;
}

ShiningLights shiningLights(const ResolvedFrame& frame, const glm::dvec3& origin) {
  const std::vector<Light>& lights = *frame.spec.lights;
  return {lightData(litLights(lights, ShadowPlan{}, origin)), origin, lights, shadowingLights(frame)};
}

/// A text that differs where the lights do.
std::string lightsText(const ShiningLights& shining) {
  Values text;
  for (std::size_t i = 0; i < shining.data.size(); ++i) {
    const Light& light = shining.lights[i];
    const shared::LightData& data = shining.data[i];
    text.add(data.type).add(directionOf(light)).add(light.position.value_or(Vec3{})).add(data.range);
    text.add(data.radiance).add(data.coneScale).add(data.coneOffset).add(strengthOf(shining, i));
    text.add(light.cullingMask).add(light.shadow->blendedCasters);
  }
  return text.take();
}

/// A text that differs where what casts shadows on volumes does, of one file's frames.
std::string castersText(const ResolvedFrame& frame) {
  Values text;
  text.add(frame.scene);
  for (const NodeSwitches& node : frame.nodes) text.add(node.castShadow).add(node.layers);
  std::string pose;
  if (const auto& moment = frame.spec.animation) {
    text.add(moment->timeSeconds).add(moment->index.value_or(-1));
    pose = moment->name.value_or("");
  }
  for (const NodeOptions& entry : frame.spec.nodes) addPlace(entry, text);
  return text.take() + pose;
}

/// The share of each light that surfaces let through to each point of a volume's map; empty for lights that all of
/// reaches it.
using LightShares = std::vector<std::vector<float>>;

/// By rays to the middle of each light that casts shadows. `size`: of the volume's map.
LightShares surfaceShares(const ShiningLights& shining, const TraceInput& rays, const VolumeSpace& space,
                          const glm::ivec3& size) {
  LightShares shares(shining.lights.size());
  const glm::dvec3 anchor = anchorOf(rays.traced.view());
  for (std::size_t light = 0; light < shares.size(); ++light) {
    const double strength = strengthOf(shining, light);
    if (strength == 0) continue;
    const TracedLight traced(rays, static_cast<int>(light));
    std::vector<float>& own = shares[light];
    own.resize(pointsOf(size));
    forEachPiece(own.size(), kPiece, [&](std::size_t first, std::size_t last) {
      std::vector<glm::dvec3> places;
      for (std::size_t i = first; i < last; ++i) places.push_back(latticePlace(space, size, i) - anchor);
      const std::span<float> piece(own.data() + first, last - first);
      traced.airVisibility(places, piece);
      for (float& share : piece) share = static_cast<float>(1 - strength * (1 - double{share}));
    });
  }
  return shares;
}

/// One a light. Refer to both, which must outlive them. `shares`: empty = no surface blocks any light.
std::vector<ArrivalAt> arrivalsOf(const ShiningLights& shining, const LightShares& shares) {
  std::vector<ArrivalAt> arrivals;
  for (std::size_t i = 0; i < shining.data.size(); ++i) {
    arrivals.push_back([&shining, &shares, i](std::size_t point, const glm::dvec3& place) {
      const Light& light = shining.lights[i];
      Arrival arrival;
      glm::vec3 towards;
      arrival.irradiance = glm::dvec3(shared::irradiance(shining.data[i], glm::vec3(place - shining.origin), towards));
      if (traitsOf(light.type).parallel) {
        arrival.towards = -directionOf(light);
      } else {
        const glm::dvec3 way = toVector(*light.position) - place;
        arrival.distance = glm::length(way);
        if (arrival.distance > 0) arrival.towards = way / arrival.distance;
      }
      if (!shares.empty() && !shares[i].empty()) arrival.surfaceVisibility = double{shares[i][point]};
      return arrival;
    });
  }
  return arrivals;
}

/// Radiance, over all directions.
glm::dvec3 meanAround(const ResolvedFrame& frame, const FrameEnvironment& environment) {
  if (environment.environment) return environment.environment->prefiltered.mean * environment.intensity;
  const double mean = environment.studioLamps ? 0.580 : 0.598; // of shared::radianceOfStudio
  return studioRadiance(frame.spec) * mean;
}

/// One a volume of the spec; null = it is hidden.
Result<std::vector<std::shared_ptr<const Medium>>> mediaOf(VolumeCache& cache, const Scene& scene,
                                                           const ResolvedFrame& frame) {
  const std::vector<VolumeOptions>& volumes = frame.spec.volumes;
  std::vector<std::shared_ptr<const Medium>> media(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (frame.volumes[i].hidden()) continue;
    auto medium = cache.medium(scene.grids.at(volumes[i].file), volumes[i], frame.volumes[i]);
    if (!medium) return placedAt("/volumes/" + std::to_string(i), medium.problems());
    media[i] = *std::move(medium);
  }
  return media;
}

/// The first directional light that casts shadows: what volumes take of it shades surfaces.
void chooseLight(const ResolvedFrame& frame, FrameVolumes& volumes) {
  for (const int light : shadowingLights(frame)) {
    const Light& source = (*frame.spec.lights)[static_cast<std::size_t>(light)];
    if (!traitsOf(source.type).parallel || source.shadow->strength == 0) continue;
    volumes.light = light;
    volumes.towards = -directionOf(source);
    return;
  }
}

bool findsSky(const ResolvedFrame& frame) {
  return frame.spec.environment.shadows == EnvironmentShadows::rays;
}

/// A text that differs where the share of the environment that arrives does, or its radiance, but for its object.
std::string skyText(const ResolvedFrame& frame, const FrameEnvironment& environment) {
  if (!findsSky(frame)) return {};
  Values text;
  text.add(environment.studioLamps).add(environment.mapFromWorld).add(meanAround(frame, environment));
  return text.add(frame.spec.environment.samples).take();
}

/// What reaches one of `media` of the environment; `rays` if surfaces or media hide any.
VolumeLight skyIn(const Medium& medium, const glm::ivec3& size, const TraceInput* rays, const ResolvedFrame& frame,
                  const FrameEnvironment& environment) {
  const glm::dvec3 open = meanAround(frame, environment);
  if (rays == nullptr) return openSky(open);
  const TracedSky sky(*rays);
  const int count = skyDirectionCount(frame.spec.environment.samples);
  return skyInVolume(sky, skyDirections(skyLightOf(&environment), count), open, medium.space, size);
}

/// The light in one of `volumes.media`: kept, or made now.
Result<VolumeLightStore::Found> lightIn(const FrameVolumes& volumes, std::size_t chosen, VolumeLightStore& lights,
                                        TracedSceneCache& traced, const SettledFrame& settled,
                                        const FrameEnvironment& environment) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<const Medium*> all = volumes.all();
  const Medium& medium = *all[chosen];
  const ResolvedFrame& frame = settled.frame;
  VolumeLightInput input{.media = all, .chosen = chosen, .size = volumeLightSize(*medium.grid)};
  if (volumes.light >= 0) input.towards = volumes.towards;
  const ShiningLights shining = shiningLights(frame, toWorld(medium.space, glm::dvec3(0.5)));
  const bool findSky = findsSky(frame);
  const VolumeLightKey key(input, lightsText(shining) + skyText(frame, environment), castersText(frame),
                           findSky ? environment.environment : nullptr);
  LightShares shares;
  std::optional<VolumeLight> sky;
  if (!lights.holds(key)) {
    std::optional<TraceInput> rays;
    std::shared_ptr<const TracedScene> surfaces;
    if (medium.receiveShadow && (findSky || !shining.shadowing.empty())) {
      auto found = traced.get(settled.scene, frame.scene);
      if (!found) return found.problems();
      surfaces = *std::move(found);
      rays.emplace(TraceInput{*surfaces, frame.view, 1, 1, *frame.spec.lights, frame.nodes, all});
      shares = surfaceShares(shining, *rays, medium.space, input.size);
    }
    if (findSky) sky = skyIn(medium, input.size, rays ? &*rays : nullptr, frame, environment);
  }
  const std::vector<ArrivalAt> arrivals = arrivalsOf(shining, shares);
  input.lights = arrivals;
  input.around = sky ? &*sky : nullptr;
  return lights.mapOf(key, [&] {
    VolumeLight light = makeVolumeLight(input);
    light.milliseconds = millisecondsSince(start);
    return light;
  });
}

VolumeReport reportOf(const Medium& medium, const VolumeLightStore::Found& found) {
  const auto along = [](const glm::ivec3& size) { return std::array<int, 3>{size.x, size.y, size.z}; };
  return {.voxels = along(medium.grid->size),
          .values = {double{medium.grid->range.x}, double{medium.grid->range.y}},
          .reused = !found.made,
          .lightSize = along(found.map->size),
          .lightBytes = found.map->texels.size() * sizeof(found.map->texels[0]),
          .lightMilliseconds = found.map->milliseconds};
}

} // namespace

Result<MadeVolumes> volumesOf(VolumeCache& cache, TracedSceneCache& traced, const SettledFrame& settled,
                              const FrameEnvironment& environment) {
  MadeVolumes made;
  const ResolvedFrame& frame = settled.frame;
  if (frame.spec.volumes.empty()) return made;
  const auto media = mediaOf(cache, *settled.loaded, frame);
  if (!media) return media.problems();
  FrameVolumes& volumes = made.volumes;
  std::vector<std::size_t> shown; // of the spec's volumes
  for (std::size_t i = 0; i < media->size(); ++i) {
    if ((*media)[i] == nullptr) continue;
    volumes.media.push_back((*media)[i]);
    shown.push_back(i);
  }
  if (!findsSky(frame)) volumes.ambient = meanAround(frame, environment);
  chooseLight(frame, volumes);
  made.reports.resize(media->size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto found = lightIn(volumes, i, cache.lights(), traced, settled, environment);
    if (!found) return found.problems();
    volumes.lights.push_back(found->map);
    made.reports[shown[i]] = reportOf(*volumes.media[i], *found);
  }
  return made;
}

} // namespace gnomon
