#include "renderer/frame/volumes_of_frame.h"

#include <array>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "protocol/base/text.h"
#include "protocol/spec/frame_lights.h"
#include "protocol/spec/limits.h"
#include "renderer/core/collect.h"
#include "renderer/core/vec3.h"
#include "renderer/core/visibility_limit.h"
#include "renderer/frame/light_on_volumes.h"
#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

constexpr double kMeanAround = 0.598; // of shared::irradianceAround, over all directions

std::string placeOf(std::size_t volume) {
  return "/volumes/" + std::to_string(volume);
}

/// One a volume of the spec; null = it is hidden.
Result<std::vector<std::shared_ptr<const Medium>>> mediaOf(VolumeCache& cache, const Scene& scene,
                                                           const ResolvedFrame& frame) {
  const std::vector<VolumeOptions>& volumes = frame.spec.volumes;
  std::vector<std::shared_ptr<const Medium>> media(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (frame.volumes[i].hidden()) continue;
    auto medium = cache.medium(scene.grids.at(volumes[i].file), volumes[i], frame.volumes[i]);
    if (!medium) return placedAt(placeOf(i), medium.problems());
    media[i] = *std::move(medium);
  }
  return media;
}

/// What devices keep of volumes for each pixel takes no more than a frame may have.
Status checkSize(const FrameSpec& spec) {
  const std::int64_t samples = samplesOf(spec.antialiasing);
  const std::int64_t pixel = sizeof(glm::vec4) + samples * (sizeof(float) + sizeof(std::uint16_t));
  const std::int64_t bytes = pixel * spec.width * spec.height;
  return checkVisibilityBytes(bytes, "/volumes", "A picture of this size takes too much memory with volumes.");
}

/// The first directional light that casts shadows: what volumes take of it shades surfaces.
void chooseLight(const ResolvedFrame& frame, FrameVolumes& volumes) {
  for (const int light : shadowingLights(frame)) {
    const Light& source = (*frame.spec.lights)[static_cast<std::size_t>(light)];
    if (source.type != LightType::directional || source.shadow->strength == 0) continue;
    volumes.light = light;
    volumes.towards = -directionOf(source);
    return;
  }
}

/// The light in one of `volumes.media`: kept, or made now.
Result<VolumeLightStore::Found> lightIn(const FrameVolumes& volumes, std::size_t chosen, VolumeLightStore& lights,
                                        TracedSceneCache& traced, const SettledFrame& settled) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<const Medium*> all;
  for (const auto& medium : volumes.media) all.push_back(medium.get());
  const Medium& medium = *all[chosen];
  const ResolvedFrame& frame = settled.frame;
  VolumeLightInput input{.media = all, .chosen = chosen, .size = volumeLightSize(*medium.grid)};
  if (volumes.light >= 0) input.towards = volumes.towards;
  const ShiningLights shining = shiningLights(frame, toWorld(medium.space, glm::dvec3(0.5)));
  const VolumeLightKey key(input, lightsText(shining), castersText(frame));
  LightShares shares;
  if (!lights.holds(key) && medium.receiveShadow && !shining.shadowing.empty()) {
    const auto rays = traced.get(settled.scene, frame.scene);
    if (!rays) return rays.problems();
    shares =
        surfaceShares(shining, {**rays, frame.view, 1, 1, *frame.spec.lights, frame.nodes}, medium.space, input.size);
  }
  const std::vector<ArrivalAt> arrivals = arrivalsOf(shining, shares);
  input.lights = arrivals;
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

Status checkVolumes(const Scene& loaded, const ResolvedFrame& frame) {
  const std::vector<VolumeOptions>& volumes = frame.spec.volumes;
  if (volumes.empty()) return Done{};
  ProblemList problems;
  const std::size_t lights = frame.spec.lights->size();
  if (lights > static_cast<std::size_t>(kLimits.maxVolumeLights)) {
    problems.add({ProblemCode::tooLarge, "/lights", "A frame with volumes has too many lights.",
                  std::to_string(kLimits.maxVolumeLights), std::to_string(lights)});
  }
  collect(checkSize(frame.spec), problems);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (!loaded.grids.contains(volumes[i].file)) {
      problems.add({ProblemCode::invalidValue, placeOf(i) + "/file",
                    "The upload has no .npy or .vdb file of that name.", "", volumes[i].file});
    }
    if (i >= frame.volumes.size() || frame.volumes[i].hidden()) continue;
    if (const auto space = spaceOf(volumes[i], frame.volumes[i]); !space) {
      collect(placedAt(placeOf(i), space.problems()), problems);
    }
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

Result<MadeVolumes> volumesOf(VolumeCache& cache, TracedSceneCache& traced, const SettledFrame& settled) {
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
  volumes.ambient = toVector(frame.spec.ambient.color) * (frame.spec.ambient.intensity * kMeanAround);
  chooseLight(frame, volumes);
  made.reports.resize(media->size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto found = lightIn(volumes, i, cache.lights(), traced, settled);
    if (!found) return found.problems();
    volumes.lights.push_back(found->map);
    made.reports[shown[i]] = reportOf(*volumes.media[i], *found);
  }
  return made;
}

} // namespace gnomon
