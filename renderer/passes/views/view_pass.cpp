#include "renderer/passes/views/view_pass.h"

#include <algorithm>

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {
namespace {

GLenum formatOf(View view, bool encoded) {
  if (!encoded) return GL_RGBA32F;
  return isPicture(view) ? GL_SRGB8_ALPHA8 : GL_RGBA8;
}

/// A variant that holds no more than these lights and surfaces need.
ViewVariant variantFor(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces, View view) {
  // Views of a light's tiles look into them whatever decides its shadow.
  const bool layersDecide = view == View::color || view == View::shadow || view == View::lightContribution;
  ViewVariant variant = lightVariant(inputs, shading, layersDecide);
  variant.view = view;
  variant.encoded = shading.spec.output.format == ImageFormat::png;
  variant.toneMapping = shading.spec.toneMapping;
  variant.samples = static_cast<int>(surfaces.samplePositions.size());
  variant.emission = surfaces.emission.id() != 0;
  variant.unlit = std::any_of(inputs.scene.materials.begin(), inputs.scene.materials.end(),
                              [](const Material& material) { return material.unlit; });
  variant.visibilityLayers =
      showsShadow(view) && std::any_of(shading.lights.begin(), shading.lights.end(),
                                       [](const shared::LightData& light) { return light.tiles.w > 0; });
  return variant;
}

} // namespace

ViewVariant lightVariant(const PassInputs& inputs, const ViewInputs& shading, bool layersDecide) {
  ViewVariant variant;
  variant.shadows.atlasSamples = shading.spec.atlas.samples;
  variant.receiverGroups = inputs.receiverGroups;
  variant.lights = static_cast<int>(shading.spec.lights->size());
  variant.lightLists = !shading.lightLists.empty();
  for (const shared::LightData& light : shading.lights) {
    variant.punctual = variant.punctual || light.direction.w != GNOMON_DIRECTIONAL;
    if (light.tiles.x == 0 || (layersDecide && light.tiles.w > 0)) continue;
    variant.tiles = std::max(variant.tiles, static_cast<int>(light.tiles.x));
    const int kind = static_cast<int>(light.sampling.x);
    variant.shadows.kinds.insert(kind);
    if (kind == GNOMON_FILTER_KERNEL) variant.shadows.texels.insert(static_cast<int>(light.tiles.y));
    variant.shadows.manualBias = variant.shadows.manualBias || light.bias.w > 0;
  }
  return variant;
}

bool isPicture(View view) {
  return view == View::color || view == View::cascades || view == View::texelGrid || view == View::lightContribution;
}

bool showsShadow(View view) {
  return isPicture(view) || view == View::shadow;
}

Result<DrawnView> drawView(const PassInputs& inputs, const ViewInputs& shading, const ViewSources& sources, View view) {
  const Surfaces& surfaces = sources.surfaces;
  const ViewVariant variant = variantFor(inputs, shading, surfaces, view);
  const auto program = inputs.programs.get(viewProgram(variant));
  if (!program) return program.problems();

  DrawnView drawn;
  drawn.timer = gl::Timer::start();
  drawn.color = gl::Texture({formatOf(view, variant.encoded), inputs.width, inputs.height}, "view");
  auto target = gl::Framebuffer::create({{{&drawn.color}}, {}}, "view");
  if (!target) return target.problems();
  drawn.framebuffer = std::move(*target);

  gl::PipelineState state;
  state.framebuffer = drawn.framebuffer.id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.srgbConversion = true;
  gl::apply(state);

  bindInputs(inputs);
  const ShadowBindings shadows(shading);
  const gl::Buffer lists(std::as_bytes(shading.lightLists), "light lists");
  lists.bindStorage(GNOMON_LIGHT_LIST_BUFFER);
  const gl::Sampler texels({GL_NEAREST, GL_NEAREST}, "surface texels");
  bindTexture(surfaces.ownDepth.id() != 0 ? surfaces.ownDepth : shading.survey.depth, texels, GNOMON_DEPTH_UNIT);
  bindTexture(surfaces.bits, texels, GNOMON_SURFACE_UNIT);
  bindTexture(surfaces.emission, texels, GNOMON_EMISSION_UNIT);
  bindTexture(sources.visibility.texture, texels, GNOMON_VISIBILITY_UNIT);
  bindTexture(sources.casters.nodes, texels, GNOMON_CASTER_NODE_UNIT);
  bindTexture(sources.casters.depth, texels, GNOMON_CASTER_DEPTH_UNIT);
  if (showsOneLight(view)) {
    (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
    (*program)->set(GNOMON_ATLAS_SIZE,
                    glm::vec2(shading.atlas.textures->depth.width(), shading.atlas.textures->depth.height()));
  }
  for (std::size_t i = 0; i < surfaces.samplePositions.size(); ++i) {
    (*program)->set(GNOMON_SAMPLE_POSITIONS + static_cast<GLint>(i), surfaces.samplePositions[i]);
  }
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);
  drawn.timer.stop();
  return drawn;
}

} // namespace gnomon
