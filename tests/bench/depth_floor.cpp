#include "tests/bench/depth_floor.h"

#include <chrono>
#include <stdexcept>

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/survey/survey_pass.h"
#include "renderer/resolve/resolve_frame.h"

namespace gnomon::bench {
namespace {

template <class T>
T valueOf(Result<T> result) {
  if (!result) throw std::runtime_error(result.problems().front().detail);
  return std::move(*result);
}

} // namespace

struct DepthFloor::Prepared {
  GpuScene gpu;
  ProgramCache programs;
  gl::Buffer frame{sizeof(shared::FrameData), "frame"};
  gl::Buffer instances;
  SceneVertices vertices;
  DrawBatch batch;
  gl::Texture depth;
  gl::Framebuffer target;
  gl::PipelineState state;
  const gl::Program* program = nullptr;
};

DepthFloor::DepthFloor(const Scene& scene, const FrameSpec& spec, int samples)
    : prepared_(std::make_unique<Prepared>()) {
  Prepared& p = *prepared_;
  const ResolvedFrame frame = valueOf(resolveFrame(scene, spec));
  const SceneView& view = scene.scenes[static_cast<std::size_t>(frame.scene)];
  p.gpu = uploadScene(scene, uploadMeshes(scene), uploadTextures(scene));
  const FrameGeometry geometry = frameGeometry(scene, view, frame.view.eye);
  p.instances = gl::Buffer(gl::bytesOf(instanceData(geometry)), "instances");
  p.vertices = sceneVertices(p.gpu, p.instances);
  shared::FrameData data{};
  const glm::mat4 clipFromRelative(clipFromView(frame.view) * viewFromRelative(frame.view));
  data.clipFromRelative = clipFromRelative;
  p.frame.update(0, gl::bytesOfValue(data));
  const PassInputs inputs{scene,      view,       p.gpu,      geometry,   frame.view,  p.frame, p.instances,
                          p.vertices, p.vertices, p.programs, spec.width, spec.height, {},      {}};
  const Survey survey = valueOf(surveyScene(inputs, samples));
  p.batch = uploadDraws(buildDrawList(scene, view, geometry, DrawUse::survey, survey.inView));
  p.depth = gl::Texture({GL_DEPTH_COMPONENT32F, spec.width, spec.height, 1, samples > 1 ? samples : 0}, "floor depth");
  p.target = valueOf(gl::Framebuffer::create({{}, {&p.depth}}, "floor"));
  p.state.framebuffer = p.target.id();
  p.state.viewport = {0, 0, spec.width, spec.height};
  p.state.depth = {true, true, GL_GREATER};
  p.state.multisample = samples > 1;
  // The shadow caster's vertex shader is the barest there is: one matrix, no output but the position.
  p.program = valueOf(p.programs.get({"shadow_cast.vert", "", {}}));
  p.program->set(GNOMON_LIGHT_CLIP, clipFromRelative);
}

DepthFloor::~DepthFloor() = default;

double DepthFloor::draw() {
  Prepared& p = *prepared_;
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  gl::apply(p.state);
  p.target.clearDepth(0.0f);
  p.frame.bindUniform(GNOMON_FRAME_BUFFER);
  for (const DrawPiece& piece : p.batch.pieces) {
    const DrawGroup& group = piece.group;
    applyFacing(group.facing, p.state);
    gl::apply(p.state);
    drawGroup(p.batch, group, p.vertices, *p.program);
  }
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

std::uint64_t DepthFloor::triangles() const {
  return prepared_->batch.triangles;
}

} // namespace gnomon::bench
