#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <span>
#include <string_view>

#include "renderer/gl/buffer.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {

/// A buffer that vertices (or instances) are read from.
struct VertexStream {
  const Buffer* buffer = nullptr;
  std::size_t stride = 0;  ///< bytes from one vertex to the next
  std::size_t offset = 0;  ///< bytes before the first
  GLuint instanceStep = 0; ///< 0 = one a vertex, n = one every n instances
};

/// One shader input.
struct VertexAttribute {
  GLuint location = 0;
  GLuint stream = 0; ///< index into the streams
  int components = 4;
  GLenum type = GL_FLOAT;
  bool normalized = false; ///< integers become 0..1 or -1..1
  GLuint offset = 0;       ///< bytes from the start of the vertex
};

/// Where a draw reads its vertices and its 32-bit indices. The buffers outlive it.
class VertexArray {
 public:
  VertexArray() = default;
  VertexArray(std::span<const VertexStream> streams, std::span<const VertexAttribute> attributes, const Buffer* indices,
              std::string_view label);

  GLuint id() const { return object_.get(); }

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteVertexArrays(1, &id); }
  };
  Object<Delete{}> object_;
};

/// One draw of an indexed triangle list, as glMultiDrawElementsIndirect reads it.
struct DrawCommand {
  std::uint32_t indexCount = 0;
  std::uint32_t instanceCount = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t baseInstance = 0; ///< where streams with an instance step begin
};

/// Draws `count` of the commands in `commands` from number `first` on, with one call. Nothing when count is 0.
void drawIndirect(const Program& program, const VertexArray& vertices, const Buffer& commands, std::size_t first,
                  std::size_t count);

/// A texture that a draw reads texel by texel; none where it is null or default-made.
struct TexelRead {
  GLuint unit = 0;
  const Texture* texture = nullptr;
};

/// One triangle over the whole viewport, without vertices: the shader makes clip positions from gl_VertexID 0, 1, 2.
/// States `state`.
void drawFullscreen(const Program& program, const PipelineState& state, std::initializer_list<TexelRead> reads = {});

/// The same band by band, for long work: once the thread's task is to end (core/stop.h), no more bands are drawn.
void drawBands(const Program& program, PipelineState state, std::initializer_list<TexelRead> reads = {});

/// Hands what was drawn so far to the device, without waiting for it.
void submit();

/// A point among the device's work.
class Fence {
 public:
  Fence(); ///< behind what was drawn so far, which is submitted
  ~Fence();
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  /// Until the device has passed it. Throws Stopped.
  void wait() const;

 private:
  GLsync sync_;
};

/// Long work step by step, of which little is left to do once it is to be stopped.
class Steps {
 public:
  /// Ends a step. Where the thread's task may be stopped, waits until the device is done with all but two of them, or
  /// throws Stopped.
  void end();

 private:
  std::deque<Fence> ended_;
};

/// Where the thread's task may be stopped, waits until the device is done with what was drawn so far, or throws
/// Stopped. Else returns at once: what needs the result waits by itself, and can't be stopped.
void waitUnlessStopped();

} // namespace gnomon::gl
