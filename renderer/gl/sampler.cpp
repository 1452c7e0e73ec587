#include "renderer/gl/sampler.h"

namespace gnomon::gl {
namespace {

void set(GLuint id, GLenum name, GLenum value) {
  glSamplerParameteri(id, name, static_cast<GLint>(value));
}

GLuint makeSampler(const SamplerState& state, std::string_view label) {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  set(id, GL_TEXTURE_MIN_FILTER, state.minFilter);
  set(id, GL_TEXTURE_MAG_FILTER, state.magFilter);
  set(id, GL_TEXTURE_WRAP_S, state.wrapS);
  set(id, GL_TEXTURE_WRAP_T, state.wrapT);
  if (state.compare != GL_NONE) {
    set(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    set(id, GL_TEXTURE_COMPARE_FUNC, state.compare);
  }
  glSamplerParameterfv(id, GL_TEXTURE_BORDER_COLOR, state.borderColor.data());
  setLabel(GL_SAMPLER, id, label);
  return id;
}

} // namespace

Sampler::Sampler(const SamplerState& state, std::string_view label) : object_(makeSampler(state, label)) {}

void Sampler::bind(GLuint unit) const {
  glBindSampler(unit, id());
}

} // namespace gnomon::gl
