#include "renderer/gl/context_setup.h"

#include <algorithm>
#include <array>
#include <dlfcn.h>
#include <mutex>
#include <string>
#include <utility>

#include "renderer/core/fingerprint.h"
#include "renderer/gl/debug_log.h"
#include "renderer/gl/object.h"

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

std::mutex tableMutex;
std::string tableBackend; // of the users
int tableUsers = 0;
thread_local bool threadHasContext = false;

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

SharedLibrary::SharedLibrary(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
  if (handle_) return;
  const char* error = dlerror();
  failure_ = error ? error : name;
}

void* SharedLibrary::symbol(const char* name) const {
  return handle_ ? dlsym(handle_, name) : nullptr;
}

std::string_view tableConflict(std::string_view backend) {
  if (threadHasContext) return "this thread already has a graphics context";
  const std::lock_guard lock(tableMutex);
  if (tableUsers > 0 && tableBackend != backend) return "this process already uses another back end";
  return {};
}

Result<FunctionTable> FunctionTable::load(std::string_view backend, GLADloadfunc getProcAddress) {
  if (const std::string_view conflict = tableConflict(backend); !conflict.empty()) {
    return backendProblem(std::string(conflict));
  }
  const std::lock_guard lock(tableMutex);
  if (tableUsers == 0) {
    const int version = gladLoadGL(getProcAddress);
    if (version < GLAD_MAKE_VERSION(4, 5)) {
      return backendProblem("the driver has OpenGL " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                            std::to_string(GLAD_VERSION_MINOR(version)) + " only, not 4.5");
    }
    tableBackend = backend;
  } else if (tableBackend != backend) {
    return backendProblem("this process already uses another back end");
  }
  ++tableUsers;
  threadHasContext = true;
  return FunctionTable();
}

FunctionTable::FunctionTable(FunctionTable&& other) noexcept : used_(std::exchange(other.used_, false)) {}

FunctionTable::~FunctionTable() {
  if (!used_) return;
  const std::lock_guard lock(tableMutex);
  --tableUsers;
  threadHasContext = false;
}

} // namespace gnomon::gl
