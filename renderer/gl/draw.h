#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/gl/gl.h"
#include "renderer/gl/program.h"
#include "renderer/gl/vertex_array.h"

namespace gnomon::gl {

/// A run of triangles in an index buffer.
struct IndexRange {
  std::uint32_t first = 0; ///< index into the index buffer
  std::uint32_t count = 0; ///< indices: three a triangle
  std::int32_t baseVertex = 0;
};

/// Runs that one call draws.
class DrawList {
 public:
  void add(const IndexRange& range);
  void clear();
  bool empty() const { return counts_.empty(); }
  std::size_t size() const { return counts_.size(); }
  std::uint64_t indices() const { return indices_; }

 private:
  friend void draw(const Program&, const VertexArray&, const DrawList&);
  std::vector<GLsizei> counts_;
  std::vector<const void*> offsets_;
  std::vector<GLint> baseVertices_;
  std::uint64_t indices_ = 0;
};

/// Draws every run with one call; the shader's gl_DrawID is the run's place in the list. Nothing when empty.
void draw(const Program& program, const VertexArray& vertices, const DrawList& list);

/// Draws one run `instances` times; a stream with an instance step begins at `baseInstance`.
void draw(const Program& program, const VertexArray& vertices, const IndexRange& range, std::uint32_t instances = 1,
          std::uint32_t baseInstance = 0);

/// One triangle over the whole viewport without vertices: gl_VertexID 0 1 2 -> clip (-1,-1) (3,-1) (-1,3) is the
/// shader's to make. `nothing` is a vertex array without streams.
void drawFullscreen(const Program& program, const VertexArray& nothing);

/// Runs a compute program and makes its writes visible to everything after it.
void dispatch(const Program& program, std::uint32_t groupsX, std::uint32_t groupsY, std::uint32_t groupsZ);

} // namespace gnomon::gl
