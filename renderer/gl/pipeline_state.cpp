#include "renderer/gl/pipeline_state.h"

namespace gnomon::gl {
namespace {

void enable(GLenum what, bool on) {
  on ? glEnable(what) : glDisable(what);
}

void applyNeutral() {
  for (const GLenum off : {GL_BLEND, GL_COLOR_LOGIC_OP, GL_DITHER, GL_PRIMITIVE_RESTART,
                           GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_RASTERIZER_DISCARD, GL_SAMPLE_ALPHA_TO_COVERAGE,
                           GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_SHADING}) {
    glDisable(off);
  }
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthRange(0.0, 1.0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void applyDepth(const DepthState& depth) {
  // Without the test nothing is written: a write without a test is a test that always passes.
  enable(GL_DEPTH_TEST, depth.test || depth.write);
  glDepthFunc(depth.test ? depth.func : GL_ALWAYS);
  glDepthMask(depth.write ? GL_TRUE : GL_FALSE);
}

void applyStencil(const std::optional<StencilState>& stencil) {
  enable(GL_STENCIL_TEST, stencil.has_value());
  const StencilState ops = stencil.value_or(StencilState{});
  glStencilFunc(GL_ALWAYS, 0, ~0u);
  glStencilMask(~0u);
  glStencilOpSeparate(GL_FRONT, GL_KEEP, ops.frontDepthFail, GL_KEEP);
  glStencilOpSeparate(GL_BACK, GL_KEEP, ops.backDepthFail, GL_KEEP);
}

} // namespace

void apply(const PipelineState& state) {
  applyNeutral();
  glBindFramebuffer(GL_FRAMEBUFFER, state.framebuffer);
  glViewport(state.viewport.x, state.viewport.y, state.viewport.width, state.viewport.height);
  const Rect scissor = state.scissor.value_or(state.viewport);
  enable(GL_SCISSOR_TEST, state.scissor.has_value());
  glScissor(scissor.x, scissor.y, scissor.width, scissor.height);
  applyDepth(state.depth);
  applyStencil(state.stencil);
  enable(GL_POLYGON_OFFSET_FILL, state.depthOffset != DepthOffset{});
  glPolygonOffset(state.depthOffset.slope, state.depthOffset.steps);
  enable(GL_DEPTH_CLAMP, state.depthClamp);
  enable(GL_CULL_FACE, state.cull != Cull::none);
  glCullFace(state.cull == Cull::front ? GL_FRONT : GL_BACK);
  glFrontFace(state.frontFace == FrontFace::clockwise ? GL_CW : GL_CCW);
  const auto& mask = state.colorMask;
  glColorMask(mask[0], mask[1], mask[2], mask[3]);
  enable(GL_MULTISAMPLE, state.multisample);
  enable(GL_SAMPLE_MASK, state.sample.has_value());
  glSampleMaski(0, state.sample ? 1u << *state.sample : ~0u);
  enable(GL_FRAMEBUFFER_SRGB, state.srgbConversion);
  for (int i = 0; i < 8; ++i) enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < state.clipDistances);
}

} // namespace gnomon::gl
