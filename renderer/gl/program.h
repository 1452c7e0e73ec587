#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

/// Which embedded shaders make a program, by file name ("view.frag").
struct ProgramSource {
  std::string vertex;
  std::string fragment;             ///< empty = depth only
  std::vector<std::string> defines; ///< "NAME" or "NAME value"
};

/// The same with the shaders' text instead of names, for shaders that are not embedded.
struct ProgramText {
  std::string vertex;
  std::string fragment;
  std::vector<std::string> defines;
};

class Program {
 public:
  Program() = default;
  /// `#version 450 core` and the defines are put before each text. A backend problem carries the driver's log.
  static Result<Program> create(const ProgramSource& source, std::string_view label);
  static Result<Program> create(const ProgramText& text, std::string_view label);

  GLuint id() const { return object_.get(); }
  void use() const;

  /// Uniforms by explicit location (`layout(location = n) uniform`).
  void set(GLint location, int value) const;
  void set(GLint location, const glm::ivec2& value) const;
  void set(GLint location, const glm::ivec4& value) const;
  void set(GLint location, const glm::vec2& value) const;
  void set(GLint location, const glm::vec4& value) const;
  void set(GLint location, const glm::mat4& value) const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteProgram(id); }
  };
  Object<Delete{}> object_;
};

} // namespace gnomon::gl
