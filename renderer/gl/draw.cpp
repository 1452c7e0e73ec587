#include "renderer/gl/draw.h"

#include <algorithm>

#include "renderer/core/stop.h"

namespace gnomon::gl {
namespace {

GLuint makeVertexArray(std::string_view label) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  setLabel(GL_VERTEX_ARRAY, id, label);
  return id;
}

} // namespace

VertexArray::VertexArray(std::span<const VertexStream> streams, std::span<const VertexAttribute> attributes,
                         const Buffer* indices, std::string_view label)
    : object_(makeVertexArray(label)) {
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const VertexStream& stream = streams[i];
    const auto slot = static_cast<GLuint>(i);
    glVertexArrayVertexBuffer(id(), slot, stream.buffer->id(), static_cast<GLintptr>(stream.offset),
                              static_cast<GLsizei>(stream.stride));
    glVertexArrayBindingDivisor(id(), slot, stream.instanceStep);
  }
  for (const VertexAttribute& attribute : attributes) {
    glEnableVertexArrayAttrib(id(), attribute.location);
    glVertexArrayAttribBinding(id(), attribute.location, attribute.stream);
    glVertexArrayAttribFormat(id(), attribute.location, attribute.components, attribute.type,
                              attribute.normalized ? GL_TRUE : GL_FALSE, attribute.offset);
  }
  if (indices) glVertexArrayElementBuffer(id(), indices->id());
}

void drawIndirect(const Program& program, const VertexArray& vertices, const Buffer& commands, std::size_t first,
                  std::size_t count) {
  if (count == 0) return;
  stopIfAsked();
  program.use();
  glBindVertexArray(vertices.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                              static_cast<GLsizei>(count), sizeof(DrawCommand));
}

void drawFullscreen(const Program& program, const PipelineState& state, std::initializer_list<TexelRead> reads) {
  const Sampler texels({GL_NEAREST, GL_NEAREST}, "texels");
  for (const TexelRead& read : reads) {
    if (read.texture == nullptr || read.texture->id() == 0) continue;
    read.texture->bind(read.unit);
    texels.bind(read.unit);
  }
  const VertexArray nothing({}, {}, nullptr, "fullscreen");
  apply(state);
  program.use();
  glBindVertexArray(nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void drawBands(const Program& program, PipelineState state, std::initializer_list<TexelRead> reads) {
  if (Stop::current() == nullptr) {
    drawFullscreen(program, state, reads);
    return;
  }
  constexpr int kRows = 64; // of the tiles in which software drivers draw
  const Rect whole = state.viewport;
  Steps bands;
  for (int row = 0; row < whole.height; row += kRows) {
    state.scissor = Rect{whole.x, whole.y + row, whole.width, std::min(kRows, whole.height - row)};
    drawFullscreen(program, state, reads);
    bands.end();
  }
}

void submit() {
  glFlush();
}

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
  submit();
}

Fence::~Fence() {
  glDeleteSync(sync_);
}

void Fence::wait() const {
  constexpr GLuint64 kAskAgain = 5'000'000; // nanoseconds
  while (glClientWaitSync(sync_, 0, kAskAgain) == GL_TIMEOUT_EXPIRED) stopIfAsked();
}

void Steps::end() {
  if (Stop::current() == nullptr) return;
  stopIfAsked();
  ended_.emplace_back();
  if (ended_.size() < 3) return;
  ended_.front().wait();
  ended_.pop_front();
}

void waitUnlessStopped() {
  if (Stop::current() != nullptr) Fence().wait();
}

} // namespace gnomon::gl
