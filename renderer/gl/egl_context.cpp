#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/context_setup.h"
#include "renderer/gl/debug_log.h"

namespace gnomon::gl {
namespace {

/// The functions of libEGL, loaded at run time.
struct EglApi {
  PFNEGLGETPROCADDRESSPROC getProcAddress = nullptr;
  PFNEGLQUERYSTRINGPROC queryString = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLBINDAPIPROC bindApi = nullptr;
  PFNEGLCHOOSECONFIGPROC chooseConfig = nullptr;
  PFNEGLCREATECONTEXTPROC createContext = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroyContext = nullptr;
  PFNEGLMAKECURRENTPROC makeCurrent = nullptr;
  PFNEGLGETERRORPROC getError = nullptr;
  PFNEGLRELEASETHREADPROC releaseThread = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr; ///< null without EGL_EXT_platform_base
  PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;             ///< null without EGL_EXT_device_enumeration
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;   ///< null without EGL_EXT_device_query
};

Result<EglApi> openEgl() {
  constexpr const char* kName = "libEGL.so.1";
  const SharedLibrary library(kName);
  if (!library.isOpen()) return backendProblem(library.failure());
  EglApi egl;
  library.load(egl.getProcAddress, "eglGetProcAddress");
  library.load(egl.queryString, "eglQueryString");
  library.load(egl.initialize, "eglInitialize");
  library.load(egl.bindApi, "eglBindAPI");
  library.load(egl.chooseConfig, "eglChooseConfig");
  library.load(egl.createContext, "eglCreateContext");
  library.load(egl.destroyContext, "eglDestroyContext");
  library.load(egl.makeCurrent, "eglMakeCurrent");
  library.load(egl.getError, "eglGetError");
  library.load(egl.releaseThread, "eglReleaseThread");
  if (!egl.getProcAddress || !egl.queryString || !egl.initialize || !egl.bindApi || !egl.chooseConfig ||
      !egl.createContext || !egl.destroyContext || !egl.makeCurrent || !egl.getError || !egl.releaseThread) {
    return backendProblem(std::string(kName) + " lacks functions of EGL 1.4");
  }
  const auto extension = [&]<class Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(egl.getProcAddress(name));
  };
  extension(egl.getPlatformDisplay, "eglGetPlatformDisplayEXT");
  extension(egl.queryDevices, "eglQueryDevicesEXT");
  extension(egl.queryDeviceString, "eglQueryDeviceStringEXT");
  return egl;
}

/// The process's libEGL.so.1, opened at the first call; a problem that says why it can't be.
const Result<EglApi>& eglApi() {
  static const Result<EglApi> api = openEgl();
  return api;
}

/// The name of the last EGL error of this thread, e.g. "EGL_BAD_MATCH".
std::string eglErrorName(const EglApi& egl) {
  constexpr std::array<const char*, 15> kNames{"EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
                                               "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
                                               "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
                                               "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
                                               "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
  const EGLint code = egl.getError() - EGL_SUCCESS;
  if (code < 0 || code >= static_cast<EGLint>(kNames.size())) return "error " + std::to_string(code + EGL_SUCCESS);
  return kNames[static_cast<std::size_t>(code)];
}

/// Whether a list separated by spaces has the name; a null list has none.
bool hasExtension(const char* extensions, std::string_view name) {
  if (!extensions) return false;
  const std::string list = " " + std::string(extensions) + " ";
  return list.find(" " + std::string(name) + " ") != std::string::npos;
}

/// A place where EGL may make a context.
struct EglPlace {
  std::string name;     ///< for messages: "EGL device 0 (hardware)"
  std::string platform; ///< "device" | "surfaceless"
  EGLenum kind = 0;
  void* native = nullptr;
};

bool isSoftwareDevice(const EglApi& egl, EGLDeviceEXT device) {
  return egl.queryDeviceString &&
         hasExtension(egl.queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

std::vector<EglPlace> devicePlaces(const EglApi& egl) {
  EGLint count = 0;
  if (!egl.queryDevices || !egl.queryDevices(0, nullptr, &count) || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (!egl.queryDevices(count, devices.data(), &count)) return {};
  devices.resize(static_cast<std::size_t>(count));
  const auto software = std::stable_partition(devices.begin(), devices.end(),
                                              [&](EGLDeviceEXT device) { return !isSoftwareDevice(egl, device); });
  const auto hardwareCount = static_cast<std::size_t>(software - devices.begin());
  std::vector<EglPlace> places;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    places.push_back({.name = "EGL device " + std::to_string(i) + (i < hardwareCount ? " (hardware)" : " (software)"),
                      .platform = "device",
                      .kind = EGL_PLATFORM_DEVICE_EXT,
                      .native = devices[i]});
  }
  return places;
}

/// Every place that this EGL offers without a window system: devices, hardware before software, then surfaceless. Never
/// the default display, which may be X or Wayland. Empty when EGL knows neither platform.
std::vector<EglPlace> eglPlaces(const EglApi& egl) {
  if (!egl.getPlatformDisplay) return {};
  const char* extensions = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EglPlace> places;
  if (hasExtension(extensions, "EGL_EXT_platform_device")) places = devicePlaces(egl);
  if (hasExtension(extensions, "EGL_MESA_platform_surfaceless")) {
    places.push_back({.name = "EGL surfaceless", .platform = "surfaceless", .kind = EGL_PLATFORM_SURFACELESS_MESA});
  }
  return places;
}

/// An initialized display. EGL has one display for a place, however often it is asked, and contexts on other threads
/// may use it: it is never terminated.
Result<EGLDisplay> openDisplay(const EglApi& egl, const EglPlace& place) {
  const EGLDisplay display = egl.getPlatformDisplay(place.kind, place.native, nullptr);
  if (display == EGL_NO_DISPLAY) return backendProblem("no display (" + eglErrorName(egl) + ")");
  if (!egl.initialize(display, nullptr, nullptr)) {
    return backendProblem("eglInitialize failed (" + eglErrorName(egl) + ")");
  }
  return display;
}

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
