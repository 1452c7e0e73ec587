#include "renderer/gl/draw.h"

namespace gnomon::gl {

void drawFullscreen(const Program& program, const VertexArray& nothing) {
  program.use();
  glBindVertexArray(nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void submit() {
  glFlush();
}

void dispatch(const Program& program, std::uint32_t groupsX, std::uint32_t groupsY, std::uint32_t groupsZ) {
  program.use();
  glDispatchCompute(groupsX, groupsY, groupsZ);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

} // namespace gnomon::gl
