#include "renderer/passes/stencil/stencil_pass.h"

#include <algorithm>
#include <array>

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/draw_batch.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/stencil/stencil_mesh.h"

namespace gnomon {
namespace {

int samplesOf(const StencilCounts& counts) {
  return std::max(1, counts.depthStencil.shape().samples);
}

std::vector<std::string> samplesDefine(int samples) {
  return {"SAMPLES " + std::to_string(samples)};
}

/// Index lists on the device, with the vertices that they go over.
struct UploadedDraws {
  gl::Buffer indices;
  gl::Buffer ranges;
  gl::VertexArray vertices;
};

using Streams = std::array<gl::VertexStream, 2>; ///< positions, then instances

UploadedDraws upload(const IndexedDraws& draws, const Streams& streams, bool weighted) {
  std::vector<gl::VertexAttribute> attributes{{GNOMON_POSITION, 0, 3, GL_FLOAT, false, 0}};
  for (GLuint row = 0; row < 3; ++row) {
    const auto offset = static_cast<GLuint>(row * sizeof(glm::vec4));
    attributes.push_back({GNOMON_INSTANCE_ROWS + row, 1, 4, GL_FLOAT, false, offset});
  }
  if (weighted) attributes.push_back({GNOMON_PLACE_WEIGHT, 0, 1, GL_FLOAT, false, sizeof(glm::vec3)});
  UploadedDraws uploaded;
  uploaded.indices = gl::Buffer(gl::bytesOf(draws.indices), "shadow volume indices");
  uploaded.ranges = gl::Buffer(gl::bytesOf(draws.ranges), "shadow volume ranges");
  uploaded.vertices = gl::VertexArray(streams, attributes, &uploaded.indices, "shadow volumes");
  return uploaded;
}

/// A surface in the plane of a caster is not in the caster's shadow, but other corners round its depths otherwise. So
/// near ends are drawn this much farther from the eye: corners snap to steps of 1/256 pixel, by half of one in either
/// triangle, along both axes. What this takes out of a volume lies right behind the caster. What is turned away on a
/// solid has no lit surface in its plane, and keeps its place: a pane a hair behind another is in its shadow.
constexpr gl::DepthOffset kBehindTheirPlane{-0.0078125f, -2.0f};

/// Draws parts of volumes into the stencil: +1 for each back face behind the surface, -1 for each front face. Equal
/// depth is behind, so that no surface is in the volume that begins at it.
class StencilDraws {
 public:
  StencilDraws(const PassInputs& inputs, const StencilCounts& counts, DrawnStencil& drawn)
      : inputs_(inputs), drawn_(drawn) {
    state_.framebuffer = counts.framebuffer.id();
    state_.viewport = {0, 0, inputs.width, inputs.height};
    state_.depth = {true, false, GL_GREATER};
    state_.stencil = gl::StencilState{GL_DECR_WRAP, GL_INCR_WRAP};
    state_.colorMask = {false, false, false, false};
    state_.multisample = samplesOf(counts) > 1;
  }

  /// What would be behind the far plane is flattened onto it.
  Status walls(const StencilMesh& mesh) {
    const gl::Buffer places(gl::bytesOf(mesh.places), "shadow volume places");
    gl::PipelineState state = state_;
    state.depthClamp = true;
    return draw(mesh.walls, {{{&places, sizeof(glm::vec4), 0, 0}, instances()}}, true, {"stencil_walls.vert", "", {}},
                state);
  }

  /// The near ends are drawn as the survey drew them, bit by bit: what it clipped is clipped. Before the near plane,
  /// nothing counts; behind the far one, `beyond` draws the rest.
  Status caps(const StencilEnds& ends, const gl::DepthOffset& offset) {
    for (const int side : {0, 1}) {
      const auto frontFace = side == 0 ? gl::FrontFace::counterClockwise : gl::FrontFace::clockwise;
      if (const Status done = capsOf(ends.sides[side], frontFace, offset, false); !done) return done;
      if (const Status done = capsOf(ends.beyond[side], frontFace, offset, true); !done) return done;
    }
    return Done{};
  }

 private:
  Status capsOf(const IndexedDraws& caps, gl::FrontFace frontFace, const gl::DepthOffset& offset, bool beyond) {
    gl::ProgramSource program = depthProgram("survey.vert", nullptr);
    if (beyond) program.defines.emplace_back("BEYOND_FAR");
    gl::PipelineState state = state_;
    state.frontFace = frontFace;
    state.depthOffset = offset;
    state.depthClamp = beyond;
    state.clipDistances = beyond ? 1 : 0;
    return draw(caps, {{{&inputs_.gpu.meshes->positions, sizeof(glm::vec3), 0, 0}, instances()}}, false, program,
                state);
  }

  gl::VertexStream instances() const { return {&inputs_.instances, sizeof(shared::InstanceData), 0, 1}; }

  Status draw(const IndexedDraws& draws, const Streams& streams, bool weighted, const gl::ProgramSource& source,
              const gl::PipelineState& state) {
    if (draws.ranges.empty()) return Done{};
    const auto program = inputs_.programs.get(source);
    if (!program) return program.problems();
    const UploadedDraws uploaded = upload(draws, streams, weighted);
    gl::apply(state);
    constexpr std::size_t kMostTriangles = 1 << 11; // each may cover the whole picture
    gl::Steps steps;
    for (const DrawRun& run : runsOf(draws.ranges, kMostTriangles)) {
      gl::drawIndirect(**program, uploaded.vertices, uploaded.ranges, run.first, run.count);
      steps.end();
    }
    drawn_.triangles += draws.indices.size() / 3;
    drawn_.drawCalls += draws.ranges.size();
    return Done{};
  }

  const PassInputs& inputs_;
  DrawnStencil& drawn_;
  gl::PipelineState state_;
};

Status countFaces(const PassInputs& inputs, const StencilCounts& counts, const StencilMesh& mesh, DrawnStencil& drawn) {
  bindInputs(inputs);
  StencilDraws draws(inputs, counts, drawn);
  if (const Status done = draws.walls(mesh); !done) return done;
  if (const Status done = draws.caps(mesh.caps, kBehindTheirPlane); !done) return done;
  if (const Status done = draws.caps(mesh.awayCaps, gl::DepthOffset{}); !done) return done;
  return Done{};
}

Status writeVisibility(const PassInputs& inputs, const StencilCounts& counts, const gl::Texture& visibility,
                       int layer) {
  const auto program =
      inputs.programs.get({"fullscreen.vert", "stencil_visibility.frag", samplesDefine(samplesOf(counts))});
  if (!program) return program.problems();
  const auto target = gl::Framebuffer::create({{{&visibility, layer}}, {}}, "visibility");
  if (!target) return target.problems();
  gl::drawFullscreen(**program, {.framebuffer = target->id(), .viewport = {0, 0, inputs.width, inputs.height}},
                     {{0, &counts.depthStencil}});
  return Done{};
}

} // namespace

Result<StencilCounts> stencilCounts(const PassInputs& inputs, const gl::Texture& depth) {
  StencilCounts counts;
  const int stored = depth.shape().samples;
  counts.depthStencil =
      gl::Texture({GL_DEPTH32F_STENCIL8, inputs.width, inputs.height, 1, stored}, "shadow volume counts");
  counts.depthStencil.readStencil();
  auto target = gl::Framebuffer::create({{}, {&counts.depthStencil}}, "shadow volume counts");
  if (!target) return target.problems();
  counts.framebuffer = std::move(*target);
  const auto program = inputs.programs.get({"fullscreen.vert", "stencil_depth.frag", samplesDefine(samplesOf(counts))});
  if (!program) return program.problems();

  gl::PipelineState state;
  state.framebuffer = counts.framebuffer.id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth.write = true;
  state.multisample = stored > 0;
  for (int sample = 0; sample < samplesOf(counts); ++sample) {
    if (stored > 0) {
      state.sample = sample;
      (*program)->set(GNOMON_SAMPLE, sample);
    }
    gl::drawFullscreen(**program, state, {{0, &depth}});
  }
  return counts;
}

Result<DrawnStencil> drawStencil(const PassInputs& inputs, StencilCounts& counts, const Light& light,
                                 const gl::Texture& visibility, int layer) {
  DrawnStencil drawn;
  drawn.timer = gl::Timer::start();
  const std::vector<StencilCaster> casters =
      stencilCasters(inputs.scene, inputs.view, inputs.geometry, inputs.camera, light, inputs.edges, inputs.nodes);
  drawn.casters = casters.size();
  const StencilMesh mesh = stencilMesh(inputs.scene, inputs.view, inputs.camera, placeOf(light), casters, inputs.edges);

  gl::PipelineState clear;
  clear.framebuffer = counts.framebuffer.id();
  clear.viewport = {0, 0, inputs.width, inputs.height};
  gl::apply(clear);
  counts.framebuffer.clearStencil(0);
  if (const Status counted = countFaces(inputs, counts, mesh, drawn); !counted) return counted.problems();
  if (const Status written = writeVisibility(inputs, counts, visibility, layer); !written) return written.problems();
  drawn.timer.stop();
  return drawn;
}

} // namespace gnomon
