// What CpuFrame shows: its views, and the layers that they need.
#include <utility>

#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/cpu/cast_tiles.h"
#include "renderer/cpu/cpu_frame.h"
#include "renderer/cpu/shadow/map_queries.h"
#include "renderer/cpu/shadow/probe.h"
#include "renderer/device/sky_views.h"

namespace gnomon::cpu {
namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t bytesOf(const Image& image) {
  return std::visit([](const auto& pixels) { return pixels.size() * sizeof(pixels[0]); }, image.pixels);
}

} // namespace

Status CpuFrame::needLayers(int samples) {
  if (work_.layered.empty() || layers_.contains(samples)) return Done{};
  DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  auto made = exactLayers(camera(), work_, survey_, shown);
  if (!made) return made.problems();
  facts_.layers.insert(facts_.layers.end(), made->lights.begin(), made->lights.end());
  layers_.emplace(samples, std::move(*made));
  endPass("visibility", 0);
  return Done{};
}

Status CpuFrame::needSky(int samples) {
  if (skies_.contains(samples)) return Done{};
  const DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  auto made = skyLayer(camera(), work_, shown);
  if (!made) return made.problems();
  endPass("sky", 0);
  facts_.passes.back().rays = made->rays;
  skies_.emplace(samples, std::move(*made));
  return Done{};
}

const VolumeLayers* CpuFrame::needVolumes(const ViewRequest& request) {
  const bool shadowed = traitsOf(request.view).shadowed;
  if (work_.volumes == nullptr || work_.volumes->empty() || !shadowed || request.fullStrength) return nullptr;
  const int samples = samplesOf(request);
  const DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  const auto found = volumes_.find(samples);
  const bool made = found == volumes_.end();
  VolumeLayers& layers =
      made ? volumes_.emplace(samples, volumeLayers(work_.frame.view, shown)).first->second : found->second;
  const bool picture = request.view == View::color && layers.picture.empty();
  const bool shadow = work_.volumes->light >= 0 && layers.shadow.empty();
  if (picture) addPicture(*work_.volumes, work_.frame.view, shown, layers);
  if (shadow) addShadow(*work_.volumes, work_.frame.view, shown, layers);
  if (picture || shadow) endPass("volumes", 0);
  return &layers;
}

int CpuFrame::samplesOf(const ViewRequest& request) const {
  const bool averaged = traitsOf(request.view).source == ViewSource::picture && request.antialiased;
  return averaged ? survey_.buffer.samples : 1;
}

void CpuFrame::add(Image picture) {
  facts_.memory.targets += bytesOf(picture);
  pictures_.push_back(std::move(picture));
}

Status CpuFrame::showOne(const ShowInput& input, const ViewRequest& request) {
  const ViewTraits& traits = traitsOf(request.view);
  if (traits.source == ViewSource::atlas) {
    add(atlasPicture(input, request, cast_));
    return Done{};
  }
  const int samples = samplesOf(request);
  if (traits.shadowed) {
    if (const Status there = needLayers(samples); !there) return there.problems();
  }
  const bool sky = showsSkyShadow(work_, request, input.debugLight);
  if (sky) {
    if (const Status there = needSky(samples); !there) return there.problems();
  }
  if (traits.material) {
    if (const Status made = cached_.textures->need(missingTextures(samples)); !made) return made.problems();
  }
  const VolumeLayers* volumes = needVolumes(request);
  const DepthBuffer& shown = surfaces(samples);
  passStart_ = Clock::now();
  std::vector<LitLight> full;
  if (request.fullStrength) full = atFullStrength({input.lights.begin(), input.lights.end()});
  const ShownLights lights(input.plan, request.fullStrength ? std::span<const LitLight>(full) : input.lights, cast_);
  const auto exact = layers_.find(samples);
  const std::vector<Layer> layers = exact == layers_.end() ? std::vector<Layer>{} : exact->second.layers(shown);
  ShadowMaps maps = lights.maps(layers);
  if (volumes != nullptr && work_.volumes->light >= 0) {
    maps.volumeLight = work_.volumes->light;
    maps.volumes = {volumes->shadow.data(), shown.width, samples};
  }
  ShowJob job = jobOf(input, shown, maps);
  if (sky) job.sky = {&skies_.at(samples).values.data()->x, shown.width, samples};
  job.view = request.view;
  job.encoded = request.encoded;
  job.tone = toneOf(work_.frame.spec.toneMapping, request.encoded);
  job.fine = request.fine;
  if (volumes != nullptr && request.view == View::color) job.volumes = volumes->picture;
  ShownCasters casters;
  if (request.view == View::casterIds) casters = shownCasters(input);
  job.casters = casters.maps;
  job.slotNodes = casters.slotNodes;
  add(showView(job, request.opaque));
  endPass("view", 0);
  facts_.passes.back().view = request.view;
  return Done{};
}

ShowJob CpuFrame::jobOf(const ShowInput& input, const DepthBuffer& shown, const ShadowMaps& maps) const {
  ShowJob job{scene_, *cached_.textures, shown, maps, input.lightLists};
  job.debugLight = input.debugLight;
  return job;
}

ShownCasters CpuFrame::shownCasters(const ShowInput& input) const {
  ShownCasters casters;
  for (const Slot& slot : scene_.slots) casters.slotNodes.push_back(geometry_.instances[slot.instance].node);
  if (input.planned == nullptr) return casters;
  const std::span<const ShadowTile> tiles(input.plan.tiles);
  casters.numbered.resize(tiles.size());
  casters.maps.resize(tiles.size());
  const Light& light = (*work_.frame.spec.lights)[static_cast<std::size_t>(input.planned->light)];
  for (int i = 0; i < input.planned->tileCount; ++i) {
    const auto at = static_cast<std::size_t>(input.planned->firstTile + i);
    if (tiles[at].rect.width <= 0) continue;
    casters.numbered[at] = numberedTile(castInput(input.plan), tiles[at], light);
    casters.maps[at] = {tiles[at].rect, &casters.numbered[at], {}};
  }
  return casters;
}

Status CpuFrame::show(const ShowInput& input) {
  for (const ViewRequest& request : input.views) {
    if (const Status shown = showOne(input, request); !shown) return shown.problems();
  }
  return Done{};
}

Result<std::vector<PlacedTriangle>> CpuFrame::shownTriangles() {
  const DepthBuffer& shown = surfaces(1);
  const TriangleNumbers numbers(geometry_);
  const auto width = static_cast<std::size_t>(shown.width);
  std::vector<PlacedTriangle> triangles(width * static_cast<std::size_t>(shown.height));
  forEach(static_cast<std::size_t>(shown.height), [&](std::size_t row) {
    const int y = shown.height - 1 - static_cast<int>(row);
    std::vector<std::uint32_t> line(width);
    for (int x = 0; x < shown.width; ++x) line[static_cast<std::size_t>(x)] = shown.triangles[shown.at(x, y)];
    numbers.of(line, std::span(triangles).subspan(row * width, width));
  });
  return triangles;
}

Result<std::vector<MapFootprint>> CpuFrame::footprints(const ShowInput& input) {
  const ShownLights lights(input.plan, input.lights, cast_);
  const ShadowMaps maps = lights.maps({});
  return mapFootprints({scene_, surfaces(1), maps, input.debugLight});
}

Result<std::vector<float>> CpuFrame::probe(const ShowInput& input, std::span<const ProbePoint> points) {
  std::vector<TexelMarks> read = noTexels(input.plan);
  {
    const ShownLights lights(input.plan, input.lights, cast_);
    markProbed(lights.maps({}), scene_.frame, input.debugLight, points, read);
  }
  makeTexels(input.plan, read);
  const ShownLights lights(input.plan, input.lights, cast_); // moments lie elsewhere now
  return probedShares(lights.maps({}), scene_.frame, input.debugLight, points);
}

Image CpuFrame::picture(std::size_t index) {
  return pictures_[index];
}

Image CpuFrame::takePicture(std::size_t index) {
  return std::move(pictures_[index]);
}

} // namespace gnomon::cpu
