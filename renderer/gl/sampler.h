#pragma once

#include <array>
#include <string_view>

#include "renderer/gl/object.h"

namespace gnomon::gl {

struct SamplerState {
  GLenum minFilter = GL_LINEAR;
  GLenum magFilter = GL_LINEAR;
  GLenum wrapS = GL_CLAMP_TO_EDGE;
  GLenum wrapT = GL_CLAMP_TO_EDGE;
  GLenum compare = GL_NONE; ///< GL_NONE, or a comparison such as GL_LEQUAL for sampler2DShadow
  std::array<float, 4> borderColor{};

  bool operator==(const SamplerState&) const = default;
};

class Sampler {
 public:
  Sampler() = default;
  Sampler(const SamplerState& state, std::string_view label);

  GLuint id() const { return object_.get(); }
  void bind(GLuint unit) const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteSamplers(1, &id); }
  };
  Object<Delete{}> object_;
};

} // namespace gnomon::gl
