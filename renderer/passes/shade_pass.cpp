#include "renderer/passes/shade_pass.h"

#include <limits>

#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/sampler.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"

namespace gnomon {
namespace {

bool isPicture(View view) {
  return view == View::color || view == View::cascades;
}

GLenum formatOf(View view, bool encoded) {
  if (!encoded) return GL_RGBA32F;
  return isPicture(view) ? GL_SRGB8_ALPHA8 : GL_RGBA8;
}

/// What stands where there is no surface.
glm::vec4 clearValue(View view, bool encoded, const Background& background) {
  if (isPicture(view)) {
    return {background.color[0], background.color[1], background.color[2], background.alpha};
  }
  if (view == View::depth && !encoded) return glm::vec4(std::numeric_limits<float>::infinity());
  if (view == View::shadow) return glm::vec4(1.0f);
  return glm::vec4(0.0f);
}

Status drawView(const PassInputs& inputs, const DrawBatch& batch, ShadeVariant variant, gl::PipelineState state) {
  for (const DrawGroup& group : batch.groups) {
    const Material& material = inputs.scene.materials[static_cast<std::size_t>(group.material)];
    variant.tangents = group.tangents;
    const auto program = inputs.programs.get(shadeProgram(material, variant));
    if (!program) return program.problems();
    bindMaterial(inputs.gpu, group.material, **program);
    state.cull = group.cull;
    state.frontFace = group.frontFace;
    gl::apply(state);
    drawGroup(batch, group, inputs.vertices, **program);
  }
  return Done{};
}

/// A variant that holds no more than these lights need.
ShadeVariant variantFor(const ShadeInputs& shade, View view, bool encoded) {
  ShadeVariant variant{view, encoded, shade.spec.toneMapping, false, 0, false, std::nullopt};
  variant.lights = static_cast<int>(shade.spec.lights->size());
  for (const shared::LightData& light : shade.lights.first(shade.spec.lights->size())) {
    variant.punctual = variant.punctual || light.direction.w != GNOMON_DIRECTIONAL;
    if (light.tiles.x == 0) continue;
    const int size = static_cast<int>(light.tiles.y);
    variant.filterSize = variant.filterSize.value_or(size) == size ? size : 0;
  }
  return variant;
}

/// Lights and tiles on the device.
struct LightBuffers {
  gl::Buffer lights;
  gl::Buffer tiles;
};

void bindShading(const PassInputs& inputs, const ShadeInputs& shade, const LightBuffers& buffers,
                 const gl::Sampler& compare) {
  bindInputs(inputs);
  buffers.lights.bindUniform(GNOMON_LIGHT_BUFFER);
  buffers.tiles.bindUniform(GNOMON_TILE_BUFFER);
  if (shade.atlas.depth.id() == 0) return;
  shade.atlas.depth.bind(GNOMON_ATLAS_UNIT);
  compare.bind(GNOMON_ATLAS_UNIT);
}

} // namespace

Result<ShadedView> shadeView(const PassInputs& inputs, const ShadeInputs& shade, View view) {
  const bool encoded = shade.spec.output.format == ImageFormat::png;
  const int samples = isPicture(view) ? shade.samples : 1;
  // With the survey's own samples its depth and its visible clusters are exact; else the view finds its own.
  const bool reuse = samples == shade.samples;
  const DrawBatch batch = uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::shade,
                                                    reuse ? shade.survey.visible : shade.survey.drawn));

  const int stored = samples > 1 ? samples : 0;
  const gl::TextureShape shape{formatOf(view, encoded), inputs.width, inputs.height, 1, stored};
  gl::Texture color(shape, "view color");
  gl::Texture ownDepth;
  if (!reuse) ownDepth = gl::Texture({GL_DEPTH_COMPONENT32F, inputs.width, inputs.height}, "view depth");
  auto target = gl::Framebuffer::create({{{&color}}, {reuse ? &shade.survey.depth : &ownDepth}}, "view");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = reuse ? gl::DepthState{true, false, GL_EQUAL} : gl::DepthState{true, true, GL_GREATER};
  state.multisample = samples > 1;
  state.srgbConversion = true;
  gl::apply(state);
  target->clearColor(0, clearValue(view, encoded, shade.spec.background));
  if (!reuse) target->clearDepth(0.0f);

  const gl::Sampler compare({GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE, GL_LEQUAL, {0, 0, 0, 0}},
                            "shadow compare");
  const LightBuffers buffers{{std::as_bytes(shade.lights), "lights"}, {std::as_bytes(shade.tiles), "tiles"}};
  bindShading(inputs, shade, buffers, compare);
  const ShadeVariant variant = variantFor(shade, view, encoded);
  if (const Status drawn = drawView(inputs, batch, variant, state); !drawn) return drawn.problems();

  ShadedView shaded{{}, {}, batch.triangles, batch.drawCalls};
  if (samples == 1) {
    shaded.color = std::move(color);
    shaded.framebuffer = std::move(*target);
    return shaded;
  }
  gl::TextureShape resolved = shape;
  resolved.samples = 0;
  shaded.color = gl::Texture(resolved, "view resolved");
  auto resolve = gl::Framebuffer::create({{{&shaded.color}}, {}}, "view resolved");
  if (!resolve) return resolve.problems();
  gl::copyColor(*target, 0, *resolve, 0, {0, 0, inputs.width, inputs.height});
  shaded.framebuffer = std::move(*resolve);
  return shaded;
}

} // namespace gnomon
