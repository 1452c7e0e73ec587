#include "renderer/passes/views/shown_triangles.h"

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/draw_batch.h"

namespace gnomon {

Result<std::vector<std::uint32_t>> shownTriangles(const PassInputs& inputs, const Surfaces& surfaces) {
  const std::size_t samples = surfaces.samplePositions.size();
  std::vector<std::uint32_t> shown(static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height) *
                                   samples);
  const Rect whole{0, 0, inputs.width, inputs.height};
  const auto texels = std::as_writable_bytes(std::span(shown));
  if (samples == 1) {
    surfaces.triangleNumbers.read(0, whole, {GL_RED_INTEGER, GL_UNSIGNED_INT}, texels);
    return shown;
  }
  const auto numbers =
      drawTexture(inputs.programs, "triangle_samples.frag", surfaces.triangleNumbers, GNOMON_SURFACE_UNIT, GL_RGBA32UI);
  if (!numbers) return numbers.problems();
  numbers->read(0, whole, {GL_RGBA_INTEGER, GL_UNSIGNED_INT}, texels);
  return shown;
}

namespace {

/// The slots with holes that nothing surely hides.
std::vector<std::uint8_t> maskedSlots(const PassInputs& inputs, const Survey& survey) {
  std::vector<std::uint8_t> slots = survey.visible;
  for (std::size_t i = 0; i < inputs.view.instances.size(); ++i) {
    const int material = materialOf(inputs.scene, inputs.view.instances[i]);
    if (hasHoles(inputs.scene.materials[static_cast<std::size_t>(material)])) continue;
    std::fill(slots.begin() + inputs.geometry.firstSlot[i], slots.begin() + inputs.geometry.firstSlot[i + 1], 0);
  }
  return slots;
}

} // namespace

Result<std::vector<std::uint8_t>> maskCoverage(const PassInputs& inputs, const Survey& survey) {
  DrawList list =
      buildDrawList(inputs.scene, inputs.view, inputs.geometry, DrawUse::survey, maskedSlots(inputs, survey));
  if (list.ranges.empty()) return std::vector<std::uint8_t>{};
  for (DrawGroup& group : list.groups) group.material = -1; // nothing but positions matters
  const auto program = inputs.programs.get({"survey.vert", "covered.frag", {}});
  if (!program) return program.problems();

  const gl::Texture covered({GL_R8, inputs.width, inputs.height}, "masks");
  const bool depth = survey.samples == 1;
  auto target = gl::Framebuffer::create({{{&covered}}, {depth ? &survey.depth : nullptr}}, "masks");
  if (!target) return target.problems();
  gl::PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, inputs.width, inputs.height};
  state.depth = {depth, false, GL_GEQUAL};
  gl::apply(state);
  target->clearColor(0, glm::vec4(0.0f));
  bindInputs(inputs);
  const Status drawn =
      drawGroups(inputs, inputs.vertices, uploadDraws(list), state,
                 [&](const DrawGroup&, const Material*) -> Result<const gl::Program*> { return *program; });
  if (!drawn) return drawn.problems();
  std::vector<std::uint8_t> masks(static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height));
  target->readColor(0, state.viewport, {GL_RED, GL_UNSIGNED_BYTE}, std::as_writable_bytes(std::span(masks)));
  return masks;
}

} // namespace gnomon
