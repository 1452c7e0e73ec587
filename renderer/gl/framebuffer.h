#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/core/rect.h"
#include "renderer/gl/object.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {

struct Attachment {
  const Texture* texture = nullptr;
  int layer = 0; ///< of an array
};

/// What is drawn into. Color attachment i is the fragment shader's output location i.
struct Attachments {
  std::vector<Attachment> color;
  Attachment depth; ///< no texture = no depth
};

/// A framebuffer over textures that outlive it.
class Framebuffer {
 public:
  Framebuffer() = default;
  /// A backend problem that names the reason where the driver finds the attachments incomplete.
  static Result<Framebuffer> create(const Attachments& attachments, std::string_view label);

  GLuint id() const { return object_.get(); }

  /// Clears depend on the scissor and the write masks: state a PipelineState first.
  void clearColor(int attachment, const glm::vec4& color);
  void clearColor(int attachment, const glm::uvec4& color);
  void clearColor(int attachment, const glm::ivec4& color);
  void clearDepth(float depth);
  void clearStencil(int value);

  /// The texels of a rectangle, lowest row first. Waits for the GPU. REQUIRES: texels has room for them.
  void readColor(int attachment, const Rect& rect, TexelLayout layout, std::span<std::byte> texels) const;

  /// Where a sample lies in its pixel, 0..1 from the lower left corner. REQUIRES: multisampled attachments.
  glm::vec2 samplePosition(int sample) const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteFramebuffers(1, &id); }
  };
  Object<Delete{}> object_;
  int colors_ = 0;
};

} // namespace gnomon::gl
