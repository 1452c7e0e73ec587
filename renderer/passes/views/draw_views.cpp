#include "renderer/passes/views/draw_views.h"

#include <algorithm>
#include <optional>

#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/device/sky_views.h"
#include "renderer/passes/tiles/atlas_views.h"
#include "renderer/passes/views/sky_texture.h"
#include "renderer/volume/volume_picture.h"

namespace gnomon {
namespace {

/// The surveyed depth alone, for a view that shows nothing else.
Surfaces depthOnly() {
  Surfaces surfaces;
  surfaces.samplePositions = {glm::vec2(0.5f)};
  return surfaces;
}

/// View depths of all samples, metres; infinite where nothing is.
Result<std::vector<float>> viewDepths(const PassInputs& inputs, const gl::Texture& depth, std::size_t samples) {
  const std::size_t pixels = static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height);
  std::vector<float> depths(pixels * samples);
  const Rect whole{0, 0, inputs.width, inputs.height};
  const auto texels = std::as_writable_bytes(std::span(depths));
  if (samples == 1) {
    depth.read(0, whole, {GL_DEPTH_COMPONENT, GL_FLOAT}, texels);
  } else {
    const auto beside = drawTexture(inputs.programs, "sample_depths.frag", depth, GNOMON_DEPTH_UNIT, GL_RGBA32F);
    if (!beside) return beside.problems();
    beside->read(0, whole, {GL_RGBA, GL_FLOAT}, texels);
  }
  forEachPiece(depths.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) depths[i] = seenDepth(inputs.camera, depths[i]);
  });
  return depths;
}

/// `seen`: some view shows the volumes themselves.
Result<VolumeLayers> volumeLayers(const PassInputs& inputs, const Survey& survey, const Surfaces& surfaces,
                                  const FrameVolumes& volumes, bool seen) {
  VolumeLayers layers;
  layers.timer = gl::Timer::start();
  const auto depths = viewDepths(inputs, depthOf(surfaces, survey), surfaces.samplePositions.size());
  if (!depths) return depths.problems();
  const SeenSurfaces shown{inputs.camera, inputs.width, inputs.height, surfaces.samplePositions, *depths};
  const std::vector<MappedMedium> media = volumes.mapped();
  if (volumes.light >= 0) layers.shadow = volumeShadowPicture(shown, media, volumes.towards);
  if (seen) {
    const std::vector<glm::vec4> picture = marchPicture(shown, media, volumes.ambient);
    layers.picture = gl::Texture({GL_RGBA32F, inputs.width, inputs.height}, "volumes");
    layers.picture.write(0, {GL_RGBA, GL_FLOAT}, std::as_bytes(std::span(picture)));
  }
  layers.timer.stop();
  return layers;
}

/// Draws views one after the other; what several of them need is drawn for the first.
class ViewDrawing {
 public:
  ViewDrawing(const PassInputs& inputs, const Shading& shading, const FrameWork& work, const ShowInput& show)
      : inputs_(inputs), shading_(shading), work_(work), show_(show) {}

  Status draw(const ViewRequest& request) {
    const ViewTraits& traits = traitsOf(request.view);
    if (traits.source == ViewSource::atlas) return flatten();
    if (request.view == View::casterIds) {
      auto casters = drawCasterNodes(inputs_, show_.plan, show_.planned, *shading_.spec.lights);
      if (!casters) return casters.problems();
      drawn_.casters = std::move(*casters);
    }
    const bool surveyed = request.view == View::depth && shading_.survey.samples == 1;
    auto view = surveyed ? drawView(inputs_, shading_, {depthOnly(), VisibilityLayers{}, drawn_.casters}, request)
                         : shade(request, traits);
    if (!view) return view.problems();
    drawn_.views.push_back(std::move(*view));
    return Done{};
  }

  DrawnViews take() { return std::move(drawn_); }

 private:
  Status flatten() {
    drawn_.views.emplace_back();
    if (drawn_.flatAtlas.id() != 0) return Done{};
    auto flat = flattenAtlas(inputs_, shading_.atlas.textures->depth);
    if (!flat) return flat.problems();
    drawn_.flatAtlas = std::move(*flat);
    return Done{};
  }

  Result<DrawnView> shade(const ViewRequest& request, const ViewTraits& traits) {
    const int samples = samplesOf(request);
    if (const Status there = needSurfaces(samples); !there) return there.problems();
    const bool volumes = hasVolumes() && traits.shadowed;
    if (volumes) {
      if (const Status there = needVolumes(samples); !there) return there.problems();
    }
    if (traits.shadowed) {
      if (const Status there = needExactShadows(samples); !there) return there.problems();
    }
    const bool sky = showsSkyShadow(work_, request, show_.debugLight);
    if (sky) {
      if (const Status there = needSky(samples); !there) return there.problems();
    }
    const auto exact = drawn_.exactShadows.find(samples);
    const VisibilityLayers noLayers;
    ViewSources sources{drawn_.surfaces.at(samples),
                        exact == drawn_.exactShadows.end() ? noLayers : exact->second.layers, drawn_.casters};
    if (volumes && !request.fullStrength) {
      sources.volumes = &drawn_.volumes.at(samples);
      sources.volumeLight = work_.volumes->light;
    }
    if (sky) sources.sky = &drawn_.skies.at(samples);
    if (!request.fullStrength) return drawView(inputs_, shading_, sources, request);

    const std::vector<LitLight> lights = atFullStrength({shading_.lights.begin(), shading_.lights.end()});
    const LightBuffers buffers = uploadLights(lights, show_.plan, show_.lightLists);
    const Shading full{shading_.spec, shading_.survey,     shading_.atlas,      lights,
                       buffers,       shading_.lightLists, shading_.debugLight, shading_.baked};
    return drawView(inputs_, full, sources, request);
  }

  /// The lights whose visibility layers are filled once the surfaces are there.
  std::span<const int> filled() const {
    const std::size_t looked = shading_.baked.maps.size();
    return std::span(work_.layered).first(work_.layered.size() - looked);
  }

  Status needSurfaces(int samples) {
    if (drawn_.surfaces.contains(samples)) return Done{};
    const bool smooth = std::any_of(shading_.lights.begin(), shading_.lights.end(), [](const LitLight& light) {
      return light.tileCount > 0 && light.smoothTerminator;
    });
    const bool numbered = needsTriangles(filled(), *shading_.spec.lights) ||
                          shading_.spec.environment.shadows == EnvironmentShadows::rays;
    const SurfaceAsks asks{numbered, smooth, shading_.baked.maps};
    auto surfaces = drawSurfaces(inputs_, shading_.survey, samples, asks);
    if (!surfaces) return surfaces.problems();
    drawn_.surfaces.emplace(samples, std::move(*surfaces));
    return Done{};
  }

  int samplesOf(const ViewRequest& request) const {
    const bool averaged = traitsOf(request.view).source == ViewSource::picture && request.antialiased;
    return averaged ? shading_.survey.samples : 1;
  }

  bool hasVolumes() const { return work_.volumes != nullptr && !work_.volumes->empty(); }

  Status needVolumes(int samples) {
    if (drawn_.volumes.contains(samples)) return Done{};
    const bool seen = std::any_of(show_.views.begin(), show_.views.end(), [&](const ViewRequest& request) {
      return request.view == View::color && samplesOf(request) == samples;
    });
    auto layers = volumeLayers(inputs_, shading_.survey, drawn_.surfaces.at(samples), *work_.volumes, seen);
    if (!layers) return layers.problems();
    drawn_.volumes.emplace(samples, std::move(*layers));
    return Done{};
  }

  Status needSky(int samples) {
    if (drawn_.skies.contains(samples)) return Done{};
    auto sky = skyTexture(inputs_, shading_, work_, drawn_.surfaces.at(samples));
    if (!sky) return sky.problems();
    drawn_.skies.emplace(samples, std::move(*sky));
    return Done{};
  }

  Status needExactShadows(int samples) {
    const auto volumes = drawn_.volumes.find(samples);
    const auto volumeShadow =
        volumes == drawn_.volumes.end() ? std::span<const std::uint16_t>{} : std::span(volumes->second.shadow);
    const bool none = filled().empty() && volumeShadow.empty();
    if (none || drawn_.exactShadows.contains(samples)) return Done{};
    auto shadows = exactShadows(inputs_, shading_, work_, filled(), drawn_.surfaces.at(samples), volumeShadow);
    if (!shadows) return shadows.problems();
    drawn_.exactShadows.emplace(samples, std::move(*shadows));
    return Done{};
  }

  const PassInputs& inputs_;
  const Shading& shading_;
  const FrameWork& work_;
  const ShowInput& show_;
  DrawnViews drawn_;
};

} // namespace

Result<DrawnViews> drawViews(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                             const ShowInput& show) {
  ViewDrawing drawing(inputs, shading, work, show);
  for (const ViewRequest& request : show.views) {
    if (const Status drawn = drawing.draw(request); !drawn) return drawn.problems();
  }
  return drawing.take();
}

} // namespace gnomon
