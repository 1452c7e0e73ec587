#include "renderer/gl/texture.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "renderer/gl/draw.h"

namespace gnomon::gl {
namespace {

GLenum targetOf(const TextureShape& shape) {
  if (shape.layers > 0) return GL_TEXTURE_2D_ARRAY;
  return shape.samples > 0 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
}

GLuint makeTexture(const TextureShape& shape, std::string_view label) {
  assert((shape.samples == 0 && shape.layers == 0) || shape.levels == 1);
  GLuint id = 0;
  glCreateTextures(targetOf(shape), 1, &id);
  if (shape.layers > 0) {
    glTextureStorage3D(id, 1, shape.format, shape.width, shape.height, shape.layers);
  } else if (shape.samples > 0) {
    glTextureStorage2DMultisample(id, shape.samples, shape.format, shape.width, shape.height, GL_TRUE);
  } else {
    glTextureStorage2D(id, shape.levels, shape.format, shape.width, shape.height);
  }
  setLabel(GL_TEXTURE, id, label);
  return id;
}

int sizeAt(int size, int level) {
  return std::max(1, size >> level);
}

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
  setLabel(GL_SAMPLER, id, label);
  return id;
}

} // namespace

int fullLevels(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max({1, width, height})));
}

std::size_t bytesPerTexel(TexelLayout layout) {
  std::size_t components = 0;
  switch (layout.format) {
    case GL_RED:
    case GL_RED_INTEGER:
    case GL_DEPTH_COMPONENT:
      components = 1;
      break;
    case GL_RG:
    case GL_RG_INTEGER:
      components = 2;
      break;
    case GL_RGB:
    case GL_RGB_INTEGER:
      components = 3;
      break;
    case GL_RGBA:
    case GL_RGBA_INTEGER:
      components = 4;
      break;
    default:
      assert(false);
  }
  switch (layout.type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
      return components;
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_HALF_FLOAT:
      return 2 * components;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
      return 4 * components;
    default:
      assert(false);
      return 0;
  }
}

std::size_t bytesOf(const Rect& rect, TexelLayout layout) {
  return static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height) * bytesPerTexel(layout);
}

Texture::Texture(const TextureShape& shape, std::string_view label)
    : object_(makeTexture(shape, label)), shape_(shape) {}

void Texture::write(int level, TexelLayout layout, std::span<const std::byte> texels) {
  const Rect all{0, 0, sizeAt(shape_.width, level), sizeAt(shape_.height, level)};
  assert(level >= 0 && level < shape_.levels && texels.size() == bytesOf(all, layout));
  glTextureSubImage2D(id(), level, 0, 0, all.width, all.height, layout.format, layout.type, texels.data());
}

void Texture::writeLayer(int layer, TexelLayout layout, std::span<const std::byte> texels) {
  assert(layer >= 0 && layer < shape_.layers && texels.size() == bytesOf({0, 0, width(), height()}, layout));
  glTextureSubImage3D(id(), 0, 0, 0, layer, width(), height(), 1, layout.format, layout.type, texels.data());
}

void Texture::read(int level, const Rect& rect, TexelLayout layout, std::span<std::byte> texels) const {
  assert(texels.size() >= bytesOf(rect, layout));
  waitUnlessStopped();
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT); // shaders may have written it
  glGetTextureSubImage(id(), level, rect.x, rect.y, 0, rect.width, rect.height, 1, layout.format, layout.type,
                       static_cast<GLsizei>(texels.size()), texels.data());
}

void Texture::clear(int level, TexelLayout layout, std::span<const std::byte> texel) {
  assert(texel.size() == bytesPerTexel(layout));
  glClearTexImage(id(), level, layout.format, layout.type, texel.data());
}

void Texture::copyFrom(const Texture& source, const Rect& rect) {
  assert(source.shape_.format == shape_.format && source.shape_.samples == shape_.samples);
  const GLenum target = targetOf(shape_);
  glCopyImageSubData(source.id(), target, 0, rect.x, rect.y, 0, id(), target, 0, rect.x, rect.y, 0, rect.width,
                     rect.height, 1);
}

void Texture::generateLevels() {
  glGenerateTextureMipmap(id());
}

void Texture::readStencil() {
  glTextureParameteri(id(), GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
}

void Texture::bind(GLuint unit) const {
  glBindTextureUnit(unit, id());
}

std::size_t Texture::bytes() const {
  if (id() == 0) return 0;
  std::size_t bitsPerTexel = 0;
  for (const GLenum part : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
                            GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE}) {
    GLint bits = 0;
    glGetTextureLevelParameteriv(id(), 0, part, &bits);
    bitsPerTexel += static_cast<std::size_t>(bits);
  }
  std::size_t texels = 0;
  for (int level = 0; level < shape_.levels; ++level) {
    texels +=
        static_cast<std::size_t>(sizeAt(shape_.width, level)) * static_cast<std::size_t>(sizeAt(shape_.height, level));
  }
  return texels * static_cast<std::size_t>(std::max({1, shape_.samples, shape_.layers})) * bitsPerTexel / 8;
}

Sampler::Sampler(const SamplerState& state, std::string_view label) : object_(makeSampler(state, label)) {}

void Sampler::bind(GLuint unit) const {
  glBindSampler(unit, id());
}

} // namespace gnomon::gl
