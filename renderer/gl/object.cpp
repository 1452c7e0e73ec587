#include "renderer/gl/object.h"

#include <algorithm>

namespace gnomon::gl {

void setLabel(GLenum kind, GLuint id, std::string_view label) {
  constexpr std::size_t kLongest = 255; // GL_MAX_LABEL_LENGTH is at least 256, its final 0 included
  glObjectLabel(kind, id, static_cast<GLsizei>(std::min(label.size(), kLongest)), label.data());
}

} // namespace gnomon::gl
