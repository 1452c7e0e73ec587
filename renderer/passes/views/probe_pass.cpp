#include "renderer/passes/views/probe_pass.h"

#include "renderer/gl/draw.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/passes/views/shadow_bindings.h"

namespace gnomon {
namespace {

/// Whole rows of the target.
std::vector<shared::ProbeData> padded(std::span<const ProbePoint> points, const glm::dvec3& forward) {
  std::vector<shared::ProbeData> rows;
  rows.reserve(points.size() + GNOMON_PROBE_COLUMNS);
  for (const ProbePoint& point : points) {
    rows.push_back(
        {glm::vec4(point.relative, glm::dot(point.relative, forward)), glm::vec4(point.normal, point.group)});
  }
  rows.resize((rows.size() + GNOMON_PROBE_COLUMNS - 1) / GNOMON_PROBE_COLUMNS * GNOMON_PROBE_COLUMNS,
              {glm::vec4(0, 0, 0, 1), glm::vec4(0, 1, 0, 0)});
  return rows;
}

} // namespace

Result<std::vector<float>> probeShadow(const PassInputs& inputs, const Shading& shading,
                                       std::span<const ProbePoint> points) {
  if (points.empty()) return std::vector<float>{};
  const auto program = inputs.programs.get(probeProgram(lightVariant(inputs, shading, false)));
  if (!program) return program.problems();
  const std::vector<shared::ProbeData> rows = padded(points, inputs.camera.forward);
  const Rect whole{0, 0, GNOMON_PROBE_COLUMNS, static_cast<int>(rows.size()) / GNOMON_PROBE_COLUMNS};
  const gl::Texture color({GL_R32F, whole.width, whole.height}, "probes");
  const auto target = gl::Framebuffer::create({{{&color}}, {}}, "probes");
  if (!target) return target.problems();

  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, whole.width, whole.height};
  gl::apply(state);
  bindInputs(inputs);
  const gl::Buffer probes(gl::bytesOf(rows), "probes");
  probes.bindStorage(GNOMON_PROBE_BUFFER);
  const ShadowBindings bindings(shading);
  (*program)->set(GNOMON_DEBUG_LIGHT, shading.debugLight);
  const gl::VertexArray nothing({}, {}, nullptr, "fullscreen");
  gl::drawFullscreen(**program, nothing);

  std::vector<float> visibility(rows.size());
  target->readColor(0, whole, {GL_RED, GL_FLOAT}, std::as_writable_bytes(std::span(visibility)));
  visibility.resize(points.size());
  return visibility;
}

} // namespace gnomon
