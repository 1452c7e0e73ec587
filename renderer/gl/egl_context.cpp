#include <array>
#include <cassert>
#include <optional>
#include <thread>
#include <utility>

#include "renderer/gl/context_setup.h"
#include "renderer/gl/debug_log.h"
#include "renderer/gl/egl_api.h"
#include "renderer/gl/function_table.h"

namespace gnomon::gl {
namespace {

/// A surfaceless EGL context, current on this thread from `create` to its destruction.
class EglContext final : public Context {
 public:
  static Result<std::unique_ptr<Context>> create(const EglApi& egl, const EglPlace& place);
  ~EglContext() override;

 private:
  EglContext(const EglApi& egl, EGLDisplay display) : egl_(egl), display_(display) {}
  /// Empty = done.
  std::string makeCurrent();

  const EglApi& egl_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
  std::optional<FunctionTable> table_;
  std::thread::id thread_ = std::this_thread::get_id();
};

Result<std::unique_ptr<Context>> EglContext::create(const EglApi& egl, const EglPlace& place) {
  const Result<EGLDisplay> display = openDisplay(egl, place);
  if (!display) return display.problems();
  std::unique_ptr<EglContext> context(new EglContext(egl, *display));
  if (const std::string failure = context->makeCurrent(); !failure.empty()) return backendProblem(failure);
  Result<FunctionTable> table = FunctionTable::load("egl", reinterpret_cast<GLADloadfunc>(egl.getProcAddress));
  if (!table) return std::move(table).problems();
  context->table_.emplace(*std::move(table));
  setUpContext();
  context->info_ = describeContext("egl", place.platform);
  return std::unique_ptr<Context>(std::move(context));
}

std::string EglContext::makeCurrent() {
  const char* extensions = egl_.queryString(display_, EGL_EXTENSIONS);
  if (!hasExtension(extensions, "EGL_KHR_surfaceless_context")) return "no EGL_KHR_surfaceless_context";
  if (!egl_.bindApi(EGL_OPENGL_API)) return "no desktop OpenGL (" + eglErrorName(egl_) + ")";
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!hasExtension(extensions, "EGL_KHR_no_config_context")) {
    constexpr std::array<EGLint, 5> kWanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (!egl_.chooseConfig(display_, kWanted.data(), &config, 1, &count) || count == 0) {
      return "no configuration for desktop OpenGL (" + eglErrorName(egl_) + ")";
    }
  }
  constexpr std::array<EGLint, 7> kAttributes{
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  context_ = egl_.createContext(display_, config, EGL_NO_CONTEXT, kAttributes.data());
  if (context_ == EGL_NO_CONTEXT) return "no OpenGL 4.5 core context (" + eglErrorName(egl_) + ")";
  if (!egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    return "eglMakeCurrent failed (" + eglErrorName(egl_) + ")";
  }
  return {};
}

EglContext::~EglContext() {
  assert(std::this_thread::get_id() == thread_);
  if (context_ != EGL_NO_CONTEXT) {
    egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroyContext(display_, context_);
  }
  egl_.releaseThread();
}

} // namespace

Attempt tryEgl(bool requireGpu) {
  if (const std::string_view conflict = tableConflict("egl"); !conflict.empty()) {
    return {.context = nullptr, .failures = {"EGL: " + std::string(conflict)}};
  }
  const Result<EglApi>& egl = eglApi();
  if (!egl) return {.context = nullptr, .failures = {"EGL: " + egl.problems().front().detail}};
  Attempt attempt;
  for (const EglPlace& place : eglPlaces(*egl)) {
    Result<std::unique_ptr<Context>> context = EglContext::create(*egl, place);
    if (!context) {
      attempt.failures.push_back(place.name + ": " + context.problems().front().detail);
    } else if (requireGpu && (*context)->info().software) {
      attempt.failures.push_back(place.name + ": a GPU is required and " + (*context)->info().renderer +
                                 " runs on the CPU");
    } else {
      attempt.context = *std::move(context);
      return attempt;
    }
  }
  if (attempt.failures.empty())
    attempt.failures.push_back("EGL: it offers neither a device nor a surfaceless platform");
  return attempt;
}

} // namespace gnomon::gl
