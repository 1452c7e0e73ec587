#include "triangle.h"

#include <array>

#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {
namespace {

constexpr int kSize = 64;

constexpr const char* kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 color;
out vec3 shade;
void main() {
  gl_Position = vec4(position, 1.0);
  shade = color;
})";

constexpr const char* kFragment = R"(
in vec3 shade;
layout(location = 0) out vec4 target;
void main() { target = vec4(pow(shade, vec3(1.0 / 2.2)), 1.0); })";

struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> color;
};

} // namespace

Result<std::vector<std::byte>> drawTriangles() {
  const Texture color({.format = GL_RGBA8, .width = kSize, .height = kSize}, "triangle color");
  const Texture depth({.format = GL_DEPTH_COMPONENT32F, .width = kSize, .height = kSize}, "triangle depth");
  Attachments attachments;
  attachments.color = {{.texture = &color}};
  attachments.depth = {.texture = &depth};
  Result<Framebuffer> target = Framebuffer::create(attachments, "triangle");
  if (!target) return std::move(target).problems();
  ProgramText text;
  text.vertex = kVertex;
  text.fragment = kFragment;
  const Result<Program> program = Program::create(text, "triangle");
  if (!program) return program.problems();

  // The near one first, so that depth must hold the far one back.
  const std::vector<Vertex> vertices{{{-0.8f, -0.8f, 0.7f}, {1, 0, 0}}, {{0.8f, -0.8f, 0.7f}, {0, 1, 0}},
                                     {{0.0f, 0.8f, 0.7f}, {0, 0, 1}},   {{-0.9f, 0.9f, 0.3f}, {1, 1, 1}},
                                     {{-0.9f, -0.9f, 0.3f}, {1, 1, 1}}, {{0.9f, 0.9f, 0.3f}, {1, 1, 1}}};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  const std::vector<DrawCommand> commands{{.indexCount = 3}, {.indexCount = 3, .baseVertex = 3}};
  const Buffer vertexBuffer(bytesOf(vertices), "triangle vertices");
  const Buffer indexBuffer(bytesOf(indices), "triangle indices");
  const Buffer commandBuffer(bytesOf(commands), "triangle commands");
  const std::array<VertexStream, 1> streams{{{.buffer = &vertexBuffer, .stride = sizeof(Vertex)}}};
  const std::array<VertexAttribute, 2> attributes{
      {{.location = 0, .components = 3}, {.location = 1, .components = 3, .offset = offsetof(Vertex, color)}}};
  const VertexArray vertexArray(streams, attributes, &indexBuffer, "triangle");

  PipelineState state;
  state.framebuffer = target->id();
  state.viewport = {0, 0, kSize, kSize};
  state.depth = {.test = true, .write = true, .func = GL_GREATER};
  apply(state);
  target->clearColor(0, glm::vec4(0, 0, 0, 1));
  target->clearDepth(0);
  drawIndirect(*program, vertexArray, commandBuffer, 0, commands.size());

  std::vector<std::byte> pixels(kSize * kSize * 4);
  target->readColor(0, state.viewport, {GL_RGBA, GL_UNSIGNED_BYTE}, pixels);
  return pixels;
}

} // namespace gnomon::gl
