#include "renderer/passes/views/view_pass.h"

#include <algorithm>

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/sampler.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

GLenum formatOf(View view, bool encoded) {
  if (!encoded) return GL_RGBA32F;
  return isPicture(view) ? GL_SRGB8_ALPHA8 : GL_RGBA8;
}

/// A variant that holds no more than these lights and surfaces need.
ViewVariant variantFor(const PassInputs& inputs, const ViewInputs& shading, const Surfaces& surfaces, View view) {
  ViewVariant variant;
  variant.view = view;
  variant.encoded = shading.spec.output.format == ImageFormat::png;
  variant.toneMapping = shading.spec.toneMapping;
  variant.samples = static_cast<int>(surfaces.samplePositions.size());
  variant.emission = surfaces.emission.id() != 0;
  variant.shadows.atlasSamples = shading.spec.atlas.samples;
  variant.receiverGroups = inputs.receiverGroups;
  variant.lights = static_cast<int>(shading.spec.lights->size());
  variant.lightLists = !shading.lightLists.empty();
  for (const shared::LightData& light : shading.lights) {
    variant.punctual = variant.punctual || light.direction.w != GNOMON_DIRECTIONAL;
    variant.visibilityLayers = variant.visibilityLayers || (light.tiles.w > 0 && showsShadow(view));
    if (light.tiles.x == 0) continue;
    variant.tiles = std::max(variant.tiles, static_cast<int>(light.tiles.x));
    const int kind = static_cast<int>(light.sampling.x);
    variant.shadows.kinds.insert(kind);
    if (kind == GNOMON_FILTER_KERNEL) variant.shadows.texels.insert(static_cast<int>(light.tiles.y));
    variant.shadows.manualBias = variant.shadows.manualBias || light.bias.w > 0;
  }
  return variant;
}

/// Lights and tiles on the device.
struct LightBuffers {
  gl::Buffer lights;
  gl::Buffer tiles;
  gl::Buffer lists;
};

struct Samplers {
  gl::Sampler texels{{GL_NEAREST, GL_NEAREST}, "surface texels"};
  gl::Sampler compare{{GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE, GL_LEQUAL, {0, 0, 0, 0}},
                      "shadow compare"};
  gl::Sampler blurred{{GL_LINEAR, GL_LINEAR}, "shadow moments"};
};

void bindTexture(const gl::Texture& texture, const gl::Sampler& sampler, GLuint unit) {
  if (texture.id() == 0) return;
  texture.bind(unit);
  sampler.bind(unit);
}

} // namespace

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
  const LightBuffers buffers{{std::as_bytes(shading.lights), "lights"},
                             {std::as_bytes(shading.tiles), "tiles"},
                             {std::as_bytes(shading.lightLists), "light lists"}};
  buffers.lights.bindStorage(GNOMON_LIGHT_BUFFER);
  buffers.tiles.bindStorage(GNOMON_TILE_BUFFER);
  buffers.lists.bindStorage(GNOMON_LIGHT_LIST_BUFFER);
  const Samplers samplers;
  bindTexture(surfaces.ownDepth.id() != 0 ? surfaces.ownDepth : shading.survey.depth, samplers.texels,
              GNOMON_DEPTH_UNIT);
  bindTexture(surfaces.bits, samplers.texels, GNOMON_SURFACE_UNIT);
  bindTexture(surfaces.emission, samplers.texels, GNOMON_EMISSION_UNIT);
  bindTexture(shading.atlas.textures->depth, samplers.compare, GNOMON_ATLAS_UNIT);
  bindTexture(shading.atlas.textures->moments, samplers.blurred, GNOMON_MOMENTS_UNIT);
  bindTexture(sources.visibility.texture, samplers.texels, GNOMON_VISIBILITY_UNIT);
  bindTexture(sources.casters.nodes, samplers.texels, GNOMON_CASTER_NODE_UNIT);
  bindTexture(sources.casters.depth, samplers.texels, GNOMON_CASTER_DEPTH_UNIT);
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
