#include "renderer/passes/views/view_pass.h"

#include <algorithm>
#include <optional>

#include "protocol/spec/traits.h"
#include "renderer/device/shader_data.h"
#include "renderer/gl/draw.h"
#include "renderer/passes/gpu_environments.h"
#include "renderer/resolve/check_frame.h"

namespace gnomon {

namespace {

/// What is fine becomes words as it is read back.
GLenum formatOf(const ViewRequest& request) {
  if (!request.encoded || request.fine) return GL_RGBA32F;
  return traitsOf(request.view).srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
}

/// A variant that holds no more than these lights and surfaces need.
ViewVariant variantFor(const PassInputs& inputs, const Shading& shading, const ViewSources& sources, View view,
                       bool encoded) {
  const Surfaces& surfaces = sources.surfaces;
  const ViewTraits& traits = traitsOf(view);
  // Views of a light's tiles look into them whatever decides its shadow.
  const bool layersDecide = traits.shadowed && !traits.tiles;
  ViewVariant variant = lightVariant(inputs, shading, layersDecide);
  variant.view = view;
  variant.encoded = encoded;
  variant.tone = toneOf(shading.spec.toneMapping, encoded);
  variant.samples = static_cast<int>(surfaces.samplePositions.size());
  variant.smoothPlaces = surfaces.smoothPlaces.id() != 0 && (traits.shadowed || traits.oneLight);
  variant.emission = surfaces.emission.id() != 0;
  variant.unlit = std::any_of(inputs.scene.materials.begin(), inputs.scene.materials.end(),
                              [](const Material& material) { return material.unlit; });
  if (traits.shadowed) {
    variant.bakedLights = static_cast<int>(shading.baked.maps.size());
    variant.firstBaked = shading.baked.firstLayer;
  }
  variant.visibilityLayers = traits.shadowed && sources.visibility.texture.id() != 0;
  variant.shadowColor =
      traits.shadowed && std::any_of(shading.lights.begin(), shading.lights.end(),
                                     [](const LitLight& light) { return light.shadowColor != glm::dvec3(0); });
  // Other views show no light from all around.
  const bool surrounded = traits.source == ViewSource::picture && view != View::lightContribution;
  variant.environment = surrounded && inputs.environment != nullptr;
  variant.shownSurroundings = surrounded && shading.spec.environment.background != EnvironmentBackground::none;
  if (sources.volumes != nullptr) {
    variant.volumes = view == View::color;
    variant.volumeLight = sources.volumeLight;
    variant.visibilityLayers = variant.visibilityLayers || sources.volumeLight >= 0;
  }
  return variant;
}

} // namespace

LightBuffers uploadLights(std::span<const LitLight> lights, const ShadowPlan& plan,
                          std::span<const std::uint32_t> lists) {
  return {gl::Buffer(gl::bytesOf(lightData(lights)), "lights"), gl::Buffer(gl::bytesOf(tileData(plan)), "tiles"),
          gl::Buffer(std::as_bytes(lists), "light lists")};
}

ViewVariant lightVariant(const PassInputs& inputs, const Shading& shading, bool layersDecide) {
  ViewVariant variant;
  variant.shadows.atlasSamples = shading.spec.atlas.samples;
  variant.receiverGroups = inputs.receiverGroups;
  variant.lights = static_cast<int>(shading.spec.lights->size());
  variant.lightLists = shading.lightLists;
  for (const LitLight& light : shading.lights) {
    variant.punctual = variant.punctual || !traitsOf(light.type).parallel;
    if (light.tileCount == 0 || (layersDecide && light.visibilityLayer >= 0)) continue;
    variant.tiles = std::max(variant.tiles, light.tileCount);
    variant.shadows.kinds.insert(filterKind(light.filter));
    variant.shadows.moments = variant.shadows.moments || light.filter.moments;
    if (light.filter.kind == MapReadingKind::texels) variant.shadows.texels.insert(light.filter.size);
    variant.shadows.manualBias = variant.shadows.manualBias || light.manualBias.has_value();
  }
  return variant;
}

const gl::Texture& depthOf(const Surfaces& surfaces, const Survey& survey) {
  return surfaces.ownDepth.id() != 0 ? surfaces.ownDepth : survey.depth;
}

Result<DrawnView> drawView(const PassInputs& inputs, const Shading& shading, const ViewSources& sources,
                           const ViewRequest& request) {
  const Surfaces& surfaces = sources.surfaces;
  const ViewVariant variant = variantFor(inputs, shading, sources, request.view, request.encoded);
  const auto program = inputs.programs.get(viewProgram(variant));
  if (!program) return program.problems();

  DrawnView drawn;
  drawn.timer = gl::Timer::start();
  drawn.color = gl::Texture({formatOf(request), inputs.width, inputs.height}, "view");
  auto target = gl::Framebuffer::create({{{&drawn.color}}, {}}, "view");
  if (!target) return target.problems();
  drawn.framebuffer = std::move(*target);

  bindInputs(inputs);
  const ShadowBindings shadows(shading);
  std::optional<EnvironmentBinding> environment;
  if (variant.environment) environment.emplace(*inputs.environment, GNOMON_ENVIRONMENT_UNIT);
  shading.buffers.lists.bindStorage(GNOMON_LIGHT_LIST_BUFFER);
  if (traitsOf(request.view).oneLight) {
    (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
    (*program)->set(GNOMON_ATLAS_SIZE,
                    glm::vec2(shading.atlas.textures->depth.width(), shading.atlas.textures->depth.height()));
  }
  for (std::size_t i = 0; i < surfaces.samplePositions.size(); ++i) {
    (*program)->set(GNOMON_SAMPLE_POSITIONS + static_cast<GLint>(i), surfaces.samplePositions[i]);
  }
  const gl::PipelineState state{
      .framebuffer = drawn.framebuffer.id(), .viewport = {0, 0, inputs.width, inputs.height}, .srgbConversion = true};
  gl::drawBands(**program, state,
                {{GNOMON_DEPTH_UNIT, &depthOf(surfaces, shading.survey)},
                 {GNOMON_SURFACE_UNIT, &surfaces.bits},
                 {GNOMON_EMISSION_UNIT, &surfaces.emission},
                 {GNOMON_SMOOTH_UNIT, &surfaces.smoothPlaces},
                 {GNOMON_VISIBILITY_UNIT, &sources.visibility.texture},
                 {GNOMON_BAKED_UNIT, &surfaces.bakedShares},
                 {GNOMON_VOLUMES_UNIT, variant.volumes ? &sources.volumes->picture : nullptr},
                 {GNOMON_CASTER_NODE_UNIT, &sources.casters.nodes},
                 {GNOMON_CASTER_DEPTH_UNIT, &sources.casters.depth}});
  drawn.timer.stop();
  return drawn;
}

ShadowBindings::ShadowBindings(const Shading& shading)
    : texels_({GL_NEAREST, GL_NEAREST}, "shadow texels"), blurred_({GL_LINEAR, GL_LINEAR}, "shadow moments") {
  shading.buffers.lights.bindStorage(GNOMON_LIGHT_BUFFER);
  shading.buffers.tiles.bindStorage(GNOMON_TILE_BUFFER);
  const auto bind = [](const gl::Texture& texture, const gl::Sampler& sampler, GLuint unit) {
    if (texture.id() == 0) return;
    texture.bind(unit);
    sampler.bind(unit);
  };
  bind(shading.atlas.textures->depth, texels_, GNOMON_ATLAS_UNIT);
  bind(shading.atlas.textures->moments, blurred_, GNOMON_MOMENTS_UNIT);
}

Result<VisibilityLayers> makeVisibilityLayers(int width, int height, int samples, int layers) {
  const Status fits =
      checkVisibilityBytes(width, height, static_cast<std::size_t>(samples), static_cast<std::size_t>(layers));
  if (!fits) return fits.problems();
  gl::TextureShape shape{samples > 1 ? GLenum{GL_RGBA16} : GLenum{GL_R16}, width, height};
  shape.layers = layers;
  return VisibilityLayers{gl::Texture(shape, "visibility")};
}

void writeVisibility(VisibilityLayers& layers, int layer, std::span<const std::uint16_t> values) {
  const GLenum format = layers.texture.shape().format == GL_R16 ? GL_RED : GL_RGBA;
  layers.texture.writeLayer(layer, {format, GL_UNSIGNED_SHORT}, std::as_bytes(values));
}

} // namespace gnomon
