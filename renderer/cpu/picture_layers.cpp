#include "renderer/cpu/picture_layers.h"

#include <algorithm>
#include <bit>
#include <chrono>

#include "protocol/base/elapsed.h"
#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/raster.h"
#include "renderer/resolve/plan_input.h"
#include "renderer/techniques/traced_shadow.h"
#include "renderer/volume/volume_picture.h"

namespace gnomon::cpu {

SampleGrid gridOf(const DepthBuffer& surfaces) {
  SampleGrid grid{surfaces.width, surfaces.height, {}};
  for (const glm::ivec2& place : samplePlaces(surfaces.samples)) grid.positions.push_back(glm::vec2(place) / 256.0f);
  return grid;
}

ShownNumbers shownNumbers(const DepthBuffer& surfaces) {
  ShownNumbers shown{surfaces.triangles, {}, {}, static_cast<std::uint32_t>(kBlockPlaces)};
  for (int x = 0; x < surfaces.width; ++x) shown.ofColumn.push_back(static_cast<std::uint32_t>(surfaces.at(x, 0)));
  for (int y = 0; y < surfaces.height; ++y) shown.ofRow.push_back(static_cast<std::uint32_t>(surfaces.at(0, y)));
  return shown;
}

namespace {

/// Marks the places that it is asked about, and lets no triangle hide anything.
class Coverage : public Holes {
 public:
  Coverage(int width, std::vector<std::uint8_t> masks) : width_(width), masks_(std::move(masks)) {}

  unsigned filled(const HoledPlaces& places, unsigned asked) const override {
    const auto width = static_cast<std::size_t>(width_);
    for (unsigned left = asked; left != 0; left &= left - 1) {
      const int place = std::countr_zero(left);
      const auto x = static_cast<std::size_t>(places.x[place]), y = static_cast<std::size_t>(places.y[place]);
      if (x < width && y * width + x < masks_.size()) masks_[y * width + x] = 255;
    }
    return 0;
  }

  std::vector<std::uint8_t> take() { return std::move(masks_); }

 private:
  int width_;
  mutable std::vector<std::uint8_t> masks_; ///< each square of the picture is rastered by one thread
};

/// The pixels that show one of the slots: a byte each, not 0 there.
std::vector<std::uint8_t> showing(std::span<const std::uint8_t> slots, const DepthBuffer& surfaces) {
  const auto width = static_cast<std::size_t>(surfaces.width);
  std::vector<std::uint8_t> shown(width * static_cast<std::size_t>(surfaces.height));
  forEach(static_cast<std::size_t>(surfaces.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (int s = 0; s < surfaces.samples; ++s) {
        const std::uint32_t number = surfaces.triangles[surfaces.at(static_cast<int>(x), static_cast<int>(y), s)];
        if (number != kNoNumber && slots[number / kClusterTriangles] != 0) shown[y * width + x] = 255;
      }
    }
  });
  return shown;
}

/// Where masked and blended triangles lie, holes and all, that no surface hides: a byte a pixel, not 0 there. Where
/// alpha is as good as the cutoff, their holes may differ from those that rays meet. Empty where the view holds none.
/// `surfaces` is left as it is.
std::vector<std::uint8_t> maskCoverage(const CameraRaster& camera, const Survey& survey, DepthBuffer& surfaces) {
  const FrameScene& scene = camera.scene;
  std::vector<std::uint8_t> slots = survey.visible;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Material& material = scene.scene.materials[static_cast<std::size_t>(scene.slots[i].material)];
    if (!hasHoles(material)) slots[i] = 0;
  }
  if (std::none_of(slots.begin(), slots.end(), [](std::uint8_t slot) { return slot != 0; })) return {};
  Coverage coverage(scene.width, showing(slots, surfaces));
  CameraRaster covering = camera;
  covering.coverage = &coverage;
  std::uint64_t triangles = 0;
  rasterOver(covering, slots, surfaces, triangles);
  return coverage.take();
}

BakedMap bakedMap(const FrameScene& scene, const BakedLight& baked) {
  BakedMap map{.shares = baked.map.shares.data(),
               .width = baked.map.width,
               .height = baked.map.height,
               .even = baked.even.shares.data(),
               .evenColumns = baked.even.columns,
               .evenTriangles = baked.evenTriangles.data(),
               .corners = baked.layout->corners.data(),
               .firstTriangles = {}};
  for (std::size_t slot = 0; slot < scene.slots.size(); ++slot) {
    const std::uint32_t instance = scene.slots[slot].instance;
    const std::size_t before = (slot - scene.geometry.firstSlot[instance]) * kClusterTriangles;
    map.firstTriangles.push_back(static_cast<std::int32_t>(baked.layout->firstCorner[instance] / 3 + before));
  }
  return map;
}

/// Adds what rays find for the lights of `traced`, indices into FrameWork::layered.
Status traceLayers(const CameraRaster& camera, const FrameWork& work, const Survey& survey, DepthBuffer& surfaces,
                   std::span<const std::size_t> traced, ExactLayers& exact) {
  const auto scene = work.traced();
  if (!scene) return scene.problems();
  const std::vector<Light>& lights = *work.frame.spec.lights;
  const SampleGrid grid = gridOf(surfaces);
  const ShownNumbers shown = shownNumbers(surfaces);
  const std::vector<std::uint8_t> masks = maskCoverage(camera, survey, surfaces);
  const TriangleNumbers numbers(camera.scene.geometry);
  const TraceInput rays{**scene, camera.camera, surfaces.width, surfaces.height, lights, camera.nodes};
  const PicturePoints points(rays, grid, numbers, shown, masks);
  for (const std::size_t layer : traced) {
    const auto start = std::chrono::steady_clock::now();
    const int light = work.layered[layer];
    TracedShadow found = tracedShadow(points, rays, light, lights[static_cast<std::size_t>(light)].shadow->raySamples);
    exact.known[layer].values = std::move(found.values);
    exact.lights.push_back({light, millisecondsSince(start), found.tracedPixels});
  }
  return Done{};
}

/// The places of a pixel's samples, and what they show.
struct Seen {
  std::vector<glm::vec2> places;
  SeenSurfaces surfaces;

  Seen(const CameraView& view, const DepthBuffer& buffer, const VolumeLayers& layers) {
    for (const glm::ivec2& place : samplePlaces(buffer.samples)) places.push_back(glm::vec2(place) / 256.0f);
    surfaces = {view, buffer.width, buffer.height, places, layers.depths};
  }
};

} // namespace

std::size_t ExactLayers::bytes() const {
  std::size_t bytes = 0;
  for (const Known& each : known) bytes += each.values.size() * sizeof(each.values[0]);
  return bytes;
}

std::vector<Layer> ExactLayers::layers(const DepthBuffer& surfaces) const {
  std::vector<Layer> all;
  for (const Known& each : known) {
    all.push_back({each.values.data(), surfaces.width, surfaces.samples, each.map ? &*each.map : nullptr});
  }
  return all;
}

Result<ExactLayers> exactLayers(const CameraRaster& camera, const FrameWork& work, const Survey& survey,
                                DepthBuffer& surfaces) {
  ExactLayers exact;
  std::vector<std::size_t> traced;
  for (const int light : work.layered) {
    exact.known.emplace_back();
    if (techniqueOf(work.frame, light).baked) {
      exact.known.back().map = bakedMap(camera.scene, *work.baked(light));
    } else {
      traced.push_back(exact.known.size() - 1);
    }
  }
  if (traced.empty()) return exact;
  if (const Status found = traceLayers(camera, work, survey, surfaces, traced, exact); !found) return found.problems();
  return exact;
}

VolumeLayers volumeLayers(const CameraView& view, const DepthBuffer& surfaces) {
  const auto samples = static_cast<std::size_t>(surfaces.samples);
  const auto width = static_cast<std::size_t>(surfaces.width);
  VolumeLayers layers;
  layers.depths.resize(width * static_cast<std::size_t>(surfaces.height) * samples);
  forEach(static_cast<std::size_t>(surfaces.height), [&](std::size_t y) {
    for (std::size_t i = 0; i < width * samples; ++i) {
      const std::size_t place =
          surfaces.at(static_cast<int>(i / samples), static_cast<int>(y), static_cast<int>(i % samples));
      layers.depths[y * width * samples + i] = seenDepth(view, surfaces.depths[place]);
    }
  });
  return layers;
}

void addPicture(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces,
                VolumeLayers& layers) {
  const Seen seen(view, surfaces, layers);
  layers.picture = marchPicture(seen.surfaces, volumes.mapped(), volumes.ambient);
}

void addShadow(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces, VolumeLayers& layers) {
  const Seen seen(view, surfaces, layers);
  layers.shadow = volumeShadowPicture(seen.surfaces, volumes.mapped(), volumes.towards);
  layers.shadow.push_back(65535); // as Layer wants it
}

} // namespace gnomon::cpu
