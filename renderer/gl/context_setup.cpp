#include "renderer/gl/context_setup.h"

#include <algorithm>
#include <array>

#include "renderer/core/fingerprint.h"
#include "renderer/gl/debug_log.h"
#include "renderer/gl/gl.h"

namespace gnomon::gl {
namespace {

std::string text(GLenum name) {
  const GLubyte* value = glGetString(name);
  return value ? reinterpret_cast<const char*>(value) : "";
}

int integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

} // namespace

void setUpContext() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  recordDebugMessages();
}

RendererInfo describeContext(std::string backend, std::string platform) {
  RendererInfo info;
  info.backend = std::move(backend);
  info.platform = std::move(platform);
  info.vendor = text(GL_VENDOR);
  info.renderer = text(GL_RENDERER);
  info.version = text(GL_VERSION);
  info.software = isSoftwareRenderer(info.renderer);
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  info.maxTextureSize = std::min({integer(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
  info.maxSamples = std::min({integer(GL_MAX_SAMPLES), integer(GL_MAX_COLOR_TEXTURE_SAMPLES),
                              integer(GL_MAX_DEPTH_TEXTURE_SAMPLES), integer(GL_MAX_INTEGER_SAMPLES)});
  info.fingerprint = fingerprintOf(info);
  return info;
}

bool isSoftwareRenderer(const std::string& renderer) {
  constexpr std::array<std::string_view, 6> kSoftware{
      "llvmpipe", "softpipe", "swrast", "lavapipe", "Software Rasterizer", "SwiftShader"};
  return std::ranges::any_of(kSoftware,
                             [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

} // namespace gnomon::gl
