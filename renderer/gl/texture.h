#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "renderer/core/rect.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

struct TextureShape {
  GLenum format = GL_RGBA8; ///< a sized internal format
  int width = 1;            ///< texels
  int height = 1;           ///< texels
  int levels = 1;           ///< mip levels; must be 1 with samples
  int samples = 0;          ///< 0 = an ordinary 2D texture, else 2D multisample with fixed sample places
  int layers = 0;           ///< 0 = no array; an array has neither samples nor levels

  bool operator==(const TextureShape&) const = default;
};

/// How many levels a full mip chain has, down to 1 x 1.
int fullLevels(int width, int height);

/// How texels lie in client memory: rows tightly packed (no alignment), lowest row first.
struct TexelLayout {
  GLenum format = GL_RGBA;
  GLenum type = GL_UNSIGNED_BYTE;
};

/// Formats of 1 to 4 components (color, integer or depth) of 8, 16 or 32 bits.
std::size_t bytesPerTexel(TexelLayout layout);
std::size_t bytesOf(const Rect& rect, TexelLayout layout);

/// An immutable-storage 2D texture, or an array of such. Its contents are undefined until written, cleared or drawn.
class Texture {
 public:
  Texture() = default;
  Texture(const TextureShape& shape, std::string_view label);

  GLuint id() const { return object_.get(); }
  const TextureShape& shape() const { return shape_; }
  int width() const { return shape_.width; }
  int height() const { return shape_.height; }

  /// Writes the whole of a level. REQUIRES: texels has exactly the level's bytes.
  void write(int level, TexelLayout layout, std::span<const std::byte> texels);
  /// Writes the whole of a layer. REQUIRES: an array; texels has exactly the layer's bytes.
  void writeLayer(int layer, TexelLayout layout, std::span<const std::byte> texels);
  /// The texels of a rectangle of a level. Waits for the GPU. REQUIRES: texels has room for them.
  void read(int level, const Rect& rect, TexelLayout layout, std::span<std::byte> texels) const;
  void clear(int level, TexelLayout layout, std::span<const std::byte> texel);
  /// Copies a rectangle to the same place. REQUIRES: one format, as many samples, and room in both.
  void copyFrom(const Texture& source, const Rect& rect);
  void generateLevels();
  /// Shaders read its stencil from now on, not its depth. REQUIRES: a format with both.
  void readStencil();
  void bind(GLuint unit) const;

  /// What its texels take on the device, of all levels and samples; 0 for a default-made one.
  std::size_t bytes() const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteTextures(1, &id); }
  };
  Object<Delete{}> object_;
  TextureShape shape_;
};

struct SamplerState {
  GLenum minFilter = GL_LINEAR;
  GLenum magFilter = GL_LINEAR;
  GLenum wrapS = GL_CLAMP_TO_EDGE;
  GLenum wrapT = GL_CLAMP_TO_EDGE;
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
