#pragma once

#include <algorithm>
#include <glad/gl.h>
#include <string_view>
#include <utility>

namespace gnomon::gl {

/// The name of one GL object, deleted with its owner. Move-only; a moved-from or default-made owner holds 0.
/// Owners are made, used and destroyed on the context's thread, while the context lives.
template <auto destroy>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint id) : id_(id) {}
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    Object taken(std::move(other));
    std::swap(id_, taken.id_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (id_ != 0) destroy(id_);
  }

  GLuint get() const { return id_; }

 private:
  GLuint id_ = 0;
};

/// Names an object for debuggers and debug messages. `kind`: GL_BUFFER, GL_TEXTURE, ...
inline void setLabel(GLenum kind, GLuint id, std::string_view label) {
  constexpr std::size_t kLongest = 255; // GL_MAX_LABEL_LENGTH is at least 256, its final 0 included
  glObjectLabel(kind, id, static_cast<GLsizei>(std::min(label.size(), kLongest)), label.data());
}

} // namespace gnomon::gl
