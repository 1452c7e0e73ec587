#include "renderer/gl/framebuffer.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "renderer/gl/debug_log.h"
#include "renderer/gl/draw.h"

namespace gnomon::gl {
namespace {

std::string statusName(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "an attachment can't be drawn to";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "the attachments differ in their samples";
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "the driver does not support this combination of formats";
    default:
      return "status " + std::to_string(status);
  }
}

GLenum depthAttachment(GLenum format) {
  const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
  return stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

GLenum colorAttachment(int attachment) {
  return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment);
}

} // namespace

Result<Framebuffer> Framebuffer::create(const Attachments& attachments, std::string_view label) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  Framebuffer framebuffer;
  framebuffer.object_ = Object<Delete{}>(id);
  framebuffer.colors_ = static_cast<int>(attachments.color.size());
  setLabel(GL_FRAMEBUFFER, id, label);
  for (int i = 0; i < framebuffer.colors_; ++i) {
    const Attachment& color = attachments.color[static_cast<std::size_t>(i)];
    if (color.texture->shape().layers > 0) {
      glNamedFramebufferTextureLayer(id, colorAttachment(i), color.texture->id(), 0, color.layer);
    } else {
      glNamedFramebufferTexture(id, colorAttachment(i), color.texture->id(), 0);
    }
  }
  if (const Attachment& depth = attachments.depth; depth.texture) {
    glNamedFramebufferTexture(id, depthAttachment(depth.texture->shape().format), depth.texture->id(), 0);
  }
  std::vector<GLenum> targets(static_cast<std::size_t>(std::max(1, framebuffer.colors_)), GL_NONE);
  for (int i = 0; i < framebuffer.colors_; ++i) targets[static_cast<std::size_t>(i)] = colorAttachment(i);
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(targets.size()), targets.data());
  if (framebuffer.colors_ == 0) glNamedFramebufferReadBuffer(id, GL_NONE);
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    return backendProblem("the framebuffer \"" + std::string(label) + "\" is incomplete: " + statusName(status));
  }
  return framebuffer;
}

void Framebuffer::clearColor(int attachment, const glm::vec4& color) {
  glClearNamedFramebufferfv(id(), GL_COLOR, attachment, &color.x);
}

void Framebuffer::clearColor(int attachment, const glm::uvec4& color) {
  glClearNamedFramebufferuiv(id(), GL_COLOR, attachment, &color.x);
}

void Framebuffer::clearColor(int attachment, const glm::ivec4& color) {
  glClearNamedFramebufferiv(id(), GL_COLOR, attachment, &color.x);
}

void Framebuffer::clearDepth(float depth) {
  glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

void Framebuffer::clearStencil(int value) {
  glClearNamedFramebufferiv(id(), GL_STENCIL, 0, &value);
}

void Framebuffer::readColor(int attachment, const Rect& rect, TexelLayout layout, std::span<std::byte> texels) const {
  assert(attachment >= 0 && attachment < colors_ && texels.size() >= bytesOf(rect, layout));
  waitUnlessStopped();
  glNamedFramebufferReadBuffer(id(), colorAttachment(attachment));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
  glReadnPixels(rect.x, rect.y, rect.width, rect.height, layout.format, layout.type,
                static_cast<GLsizei>(texels.size()), texels.data());
}

glm::vec2 Framebuffer::samplePosition(int sample) const {
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glm::vec2 position(0.0f);
  glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(sample), &position.x);
  return position;
}

} // namespace gnomon::gl
