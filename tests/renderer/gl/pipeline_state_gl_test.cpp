#include <rapidcheck.h>
#include <vector>

#include "gl_fixture.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {
namespace {

constexpr std::array kSwitches{GL_BLEND,
                               GL_COLOR_LOGIC_OP,
                               GL_CULL_FACE,
                               GL_DEPTH_CLAMP,
                               GL_DEPTH_TEST,
                               GL_DITHER,
                               GL_FRAMEBUFFER_SRGB,
                               GL_MULTISAMPLE,
                               GL_POLYGON_OFFSET_FILL,
                               GL_PRIMITIVE_RESTART,
                               GL_PRIMITIVE_RESTART_FIXED_INDEX,
                               GL_RASTERIZER_DISCARD,
                               GL_SAMPLE_ALPHA_TO_COVERAGE,
                               GL_SAMPLE_ALPHA_TO_ONE,
                               GL_SAMPLE_COVERAGE,
                               GL_SAMPLE_MASK,
                               GL_SAMPLE_SHADING,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST,
                               GL_CLIP_DISTANCE0,
                               GL_CLIP_DISTANCE3,
                               GL_CLIP_DISTANCE7};

GLuint sampleMask() {
  GLint mask = 0;
  glGetIntegeri_v(GL_SAMPLE_MASK_VALUE, 0, &mask);
  return static_cast<GLuint>(mask);
}

/// What OpenGL says about everything that a PipelineState has a hold of.
std::vector<double> stateOfDriver() {
  std::vector<double> state;
  for (const GLenum what : kSwitches) state.push_back(glIsEnabled(what));
  for (const GLenum what :
       {GL_VIEWPORT, GL_SCISSOR_BOX, GL_DEPTH_FUNC, GL_DEPTH_WRITEMASK, GL_CULL_FACE_MODE, GL_FRONT_FACE,
        GL_COLOR_WRITEMASK, GL_DEPTH_RANGE, GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_CLIP_ORIGIN,
        GL_CLIP_DEPTH_MODE, GL_STENCIL_FUNC, GL_STENCIL_WRITEMASK, GL_STENCIL_BACK_WRITEMASK,
        GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_PASS}) {
    std::array<double, 4> values{};
    glGetDoublev(what, values.data());
    state.insert(state.end(), values.begin(), values.end());
  }
  std::array<GLint, 2> polygon{};
  glGetIntegerv(GL_POLYGON_MODE, polygon.data());
  state.push_back(polygon[0]);
  state.push_back(sampleMask());
  return state;
}

/// Leaves nothing as any pass would want it.
void leaveAMess() {
  for (const GLenum what : kSwitches) *rc::gen::arbitrary<bool>() ? glEnable(what) : glDisable(what);
  glViewport(1, 2, 3, 4);
  glScissor(4, 3, 2, 1);
  glDepthFunc(GL_NEVER);
  glDepthMask(*rc::gen::arbitrary<bool>());
  glCullFace(GL_FRONT_AND_BACK);
  glFrontFace(GL_CW);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  glDepthRange(0.75, 0.25);
  glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glStencilFunc(GL_NEVER, 3, 5);
  glStencilMask(9);
  glSampleMaski(0, 6);
  glStencilOp(GL_ZERO, GL_INVERT, GL_REPLACE);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Rect anyRect() {
  return {*rc::gen::inRange(0, 100), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 100)};
}

PipelineState anyState(GLuint framebuffer) {
  const auto yes = [] { return *rc::gen::arbitrary<bool>(); };
  PipelineState state;
  state.framebuffer = yes() ? framebuffer : 0;
  state.viewport = anyRect();
  if (yes()) state.scissor = anyRect();
  state.depth = {yes(), yes(), *rc::gen::element<GLenum>(GL_GREATER, GL_LESS, GL_EQUAL, GL_GEQUAL)};
  if (yes()) state.stencil = StencilState{*rc::gen::element<GLenum>(GL_KEEP, GL_INCR_WRAP), GL_DECR_WRAP};
  state.depthClamp = yes();
  state.cull = *rc::gen::element(Cull::none, Cull::back, Cull::front);
  state.frontFace = yes() ? FrontFace::clockwise : FrontFace::counterClockwise;
  state.colorMask = {yes(), yes(), yes(), yes()};
  state.multisample = yes();
  if (yes()) state.sample = *rc::gen::inRange(0, 4);
  state.srgbConversion = yes();
  state.clipDistances = *rc::gen::inRange(0, 9);
  return state;
}

class PipelineStates : public GlTest {};

TEST_F(PipelineStates, dependOnNothingThatWasBefore) {
  const Texture color({}, "color");
  Attachments attachments;
  attachments.color = {{.texture = &color}};
  const Framebuffer target = *Framebuffer::create(attachments, "target");
  EXPECT_TRUE(rc::check([&] {
    const PipelineState state = anyState(target.id());
    apply(PipelineState{});
    apply(state);
    const std::vector<double> afterNeutral = stateOfDriver();
    leaveAMess();
    apply(state);
    RC_ASSERT(stateOfDriver() == afterNeutral);
    apply(anyState(target.id()));
    apply(state);
    RC_ASSERT(stateOfDriver() == afterNeutral);
  }));
}

TEST_F(PipelineStates, sayWhatTheirMembersSay) {
  PipelineState state;
  state.viewport = {10, 20, 30, 40};
  state.scissor = Rect{1, 2, 3, 4};
  state.depth = {.test = true, .write = false, .func = GL_LESS};
  state.stencil = StencilState{.frontDepthFail = GL_DECR_WRAP, .backDepthFail = GL_INCR_WRAP};
  state.cull = Cull::front;
  state.frontFace = FrontFace::clockwise;
  state.colorMask = {true, false, true, false};
  state.clipDistances = 4;
  state.sample = 2;
  apply(state);
  const auto integers = [](GLenum what) {
    std::array<GLint, 4> values{};
    glGetIntegerv(what, values.data());
    return values;
  };
  EXPECT_THAT(integers(GL_VIEWPORT), testing::ElementsAre(10, 20, 30, 40));
  EXPECT_THAT(integers(GL_SCISSOR_BOX), testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(integers(GL_COLOR_WRITEMASK), testing::ElementsAre(1, 0, 1, 0));
  EXPECT_EQ(integers(GL_DEPTH_FUNC)[0], GL_LESS);
  EXPECT_EQ(integers(GL_CULL_FACE_MODE)[0], GL_FRONT);
  EXPECT_EQ(integers(GL_FRONT_FACE)[0], GL_CW);
  EXPECT_EQ(integers(GL_STENCIL_PASS_DEPTH_FAIL)[0], GL_DECR_WRAP);
  EXPECT_EQ(integers(GL_STENCIL_BACK_PASS_DEPTH_FAIL)[0], GL_INCR_WRAP);
  EXPECT_TRUE(glIsEnabled(GL_STENCIL_TEST));
  EXPECT_TRUE(glIsEnabled(GL_SCISSOR_TEST));
  EXPECT_TRUE(glIsEnabled(GL_CULL_FACE));
  EXPECT_TRUE(glIsEnabled(GL_CLIP_DISTANCE3));
  EXPECT_FALSE(glIsEnabled(GL_CLIP_DISTANCE4));
  EXPECT_TRUE(glIsEnabled(GL_SAMPLE_MASK));
  EXPECT_EQ(sampleMask(), 4u);
}

TEST_F(PipelineStates, writeDepthWithoutATest) {
  const Texture depth({.format = GL_DEPTH_COMPONENT32F}, "depth");
  Attachments attachments;
  attachments.depth = {.texture = &depth};
  const Framebuffer target = *Framebuffer::create(attachments, "target");
  PipelineState state;
  state.framebuffer = target.id();
  state.depth = {.test = false, .write = true, .func = GL_NEVER};
  apply(state);
  GLint func = 0;
  glGetIntegerv(GL_DEPTH_FUNC, &func);
  EXPECT_EQ(func, GL_ALWAYS);
  EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST)) << "OpenGL writes no depth without it";
}

} // namespace
} // namespace gnomon::gl
