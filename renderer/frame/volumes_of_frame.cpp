#include "renderer/frame/volumes_of_frame.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "protocol/base/elapsed.h"
#include "protocol/base/text.h"
#include "protocol/spec/limits.h"
#include "renderer/core/light.h"
#include "renderer/core/parallel.h"
#include "renderer/core/vec3.h"
#include "renderer/device/shader_data.h"
#include "renderer/reference/trace.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

constexpr double kMeanAround = 0.598; // of shared::irradianceAround, over all directions
constexpr std::size_t kPiece = 4096;  // points that a core traces at a time

/// One a volume of the spec; null = it is hidden.
Result<std::vector<std::shared_ptr<const Medium>>> mediaOf(VolumeCache& cache, const Scene& scene,
                                                           const ResolvedFrame& frame) {
  const std::vector<VolumeOptions>& volumes = frame.spec.volumes;
  std::vector<std::shared_ptr<const Medium>> media(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const std::string pointer = "/volumes/" + std::to_string(i);
    const auto file = scene.grids.find(volumes[i].file);
    if (file == scene.grids.end()) {
      return Problem{ProblemCode::invalidValue, pointer + "/file", "The upload has no .npy or .vdb file of that name.",
                     "", volumes[i].file};
    }
    if (frame.volumes[i].hidden()) continue;
    auto medium = cache.medium(file->second, volumes[i], frame.volumes[i]);
    if (!medium) {
      Problems problems = medium.problems();
      for (Problem& problem : problems) problem.pointer = pointer + problem.pointer;
      return problems;
    }
    media[i] = *std::move(medium);
  }
  return media;
}

/// A text that differs where values do.
class Values {
 public:
  template <class T>
  Values& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// The frame's lights as they shine on volumes.
struct ShiningLights {
  std::vector<shared::LightData> data; ///< relative to `origin`
  glm::dvec3 origin{0};
  std::span<const Light> lights;
  std::vector<int> shadowing; ///< those whose shadows fall on volumes
};

ShiningLights shiningLights(const ResolvedFrame& frame, const glm::dvec3& origin) {
  const std::vector<Light>& lights = *frame.spec.lights;
  return {lightData(litLights(lights, ShadowPlan{}, origin)), origin, lights, shadowingLights(frame)};
}

bool isShadowing(const ShiningLights& shining, std::size_t light) {
  return std::find(shining.shadowing.begin(), shining.shadowing.end(), static_cast<int>(light)) !=
         shining.shadowing.end();
}

double strengthOf(const ShiningLights& shining, std::size_t light) {
  return isShadowing(shining, light) ? shining.lights[light].shadow->strength : 0;
}

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

std::string castersText(const ResolvedFrame& frame) {
  Values text;
  text.add(frame.scene);
  for (const NodeSwitches& node : frame.nodes) text.add(node.castShadow).add(node.layers);
  std::string pose;
  if (const auto& moment = frame.spec.animation) {
    text.add(moment->timeSeconds).add(moment->index.value_or(-1));
    pose = moment->name.value_or("");
  }
  return text.take() + pose;
}

/// The share of each light that surfaces let through to each point of a volume's map; empty for lights that all of
/// reaches it.
using Shares = std::vector<std::vector<float>>;

Shares surfaceShares(const ShiningLights& shining, const TraceInput& rays, const VolumeSpace& space,
                     const glm::ivec3& size) {
  Shares shares(shining.lights.size());
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

std::vector<ArrivalAt> arrivalsOf(const ShiningLights& shining, const Shares& shares) {
  std::vector<ArrivalAt> arrivals;
  for (std::size_t i = 0; i < shining.data.size(); ++i) {
    arrivals.push_back([&shining, &shares, i](std::size_t point, const glm::dvec3& place) {
      const Light& light = shining.lights[i];
      Arrival arrival;
      glm::vec3 towards;
      arrival.irradiance = glm::dvec3(shared::irradiance(shining.data[i], glm::vec3(place - shining.origin), towards));
      if (light.type == LightType::directional) {
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

std::size_t bytesOf(const VolumeLight& light) {
  return light.texels.size() * sizeof(light.texels[0]);
}

/// What devices keep of volumes for each pixel takes no more than a frame may have.
Status checkSize(const FrameSpec& spec) {
  const std::int64_t samples = spec.antialiasing == Antialiasing::msaa4x ? 4 : 1;
  const std::int64_t pixel = sizeof(glm::vec4) + samples * (sizeof(float) + sizeof(std::uint16_t));
  const std::int64_t bytes = pixel * spec.width * spec.height;
  if (bytes <= kLimits.maxVisibilityBytes) return Done{};
  return Problem{ProblemCode::tooLarge, "/volumes", "A picture of this size takes too much memory with volumes.",
                 std::to_string(kLimits.maxVisibilityBytes) + " bytes", std::to_string(bytes) + " bytes"};
}

} // namespace

Result<MadeVolumes> volumesOf(VolumeCache& cache, TracedSceneCache& traced, const FrameScene& scene,
                              const ResolvedFrame& frame) {
  MadeVolumes made;
  if (frame.spec.volumes.empty()) return made;
  const std::vector<Light>& lights = *frame.spec.lights;
  if (lights.size() > static_cast<std::size_t>(kLimits.maxVolumeLights)) {
    return Problem{ProblemCode::tooLarge, "/lights", "A frame with volumes has too many lights.",
                   std::to_string(kLimits.maxVolumeLights), std::to_string(lights.size())};
  }
  if (const Status fits = checkSize(frame.spec); !fits) return fits.problems();
  const auto media = mediaOf(cache, *scene.loaded, frame);
  if (!media) return media.problems();
  made.reports.resize(media->size());
  std::vector<VolumeReport*> reports;
  FrameVolumes& volumes = made.volumes;
  for (std::size_t i = 0; i < media->size(); ++i) {
    if ((*media)[i] == nullptr) continue;
    volumes.media.push_back((*media)[i]);
    reports.push_back(&made.reports[i]);
  }
  volumes.ambient = toVector(frame.spec.ambient.color) * (frame.spec.ambient.intensity * kMeanAround);
  for (const int light : shadowingLights(frame)) {
    const Light& source = lights[static_cast<std::size_t>(light)];
    if (source.type != LightType::directional || source.shadow->strength == 0) continue;
    volumes.light = light;
    volumes.towards = -directionOf(source);
    break;
  }

  std::vector<const Medium*> all;
  for (const auto& medium : volumes.media) all.push_back(medium.get());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    const VolumeSpace& space = all[i]->space;
    VolumeLightInput input{.media = all, .chosen = i, .size = volumeLightSize(*all[i]->grid)};
    if (volumes.light >= 0) input.towards = volumes.towards;
    const ShiningLights shining = shiningLights(frame, toWorld(space, glm::dvec3(0.5)));
    const VolumeLightKey key(input, lightsText(shining), castersText(frame));
    Shares shares;
    if (!cache.lights().holds(key) && all[i]->receiveShadow && !shining.shadowing.empty()) {
      const auto rays = traced.get(scene.posed, frame.scene);
      if (!rays) return rays.problems();
      shares = surfaceShares(shining, {**rays, frame.view, 1, 1, lights, frame.nodes}, space, input.size);
    }
    const std::vector<ArrivalAt> arrivals = arrivalsOf(shining, shares);
    input.lights = arrivals;
    const VolumeLightStore::Found found = cache.lights().mapOf(key, [&] {
      VolumeLight light = makeVolumeLight(input);
      light.milliseconds = millisecondsSince(start);
      return light;
    });
    volumes.lights.push_back(found.map);
    const glm::ivec3 voxels = all[i]->grid->size;
    *reports[i] = {.voxels = {voxels.x, voxels.y, voxels.z},
                   .values = {all[i]->values.x, all[i]->values.y},
                   .reused = !found.made,
                   .lightSize = {input.size.x, input.size.y, input.size.z},
                   .lightBytes = bytesOf(*found.map),
                   .lightMilliseconds = found.map->milliseconds};
  }
  return made;
}

} // namespace gnomon
