#include "renderer/gl/egl_api.h"

#include <algorithm>
#include <array>

#include "renderer/gl/debug_log.h"
#include "renderer/gl/function_table.h"

namespace gnomon::gl {
namespace {

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
  const auto hardware =
      std::ranges::stable_partition(devices, [&](EGLDeviceEXT device) { return !isSoftwareDevice(egl, device); });
  const std::size_t hardwareCount = devices.size() - hardware.size();
  std::vector<EglPlace> places;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    places.push_back({.name = "EGL device " + std::to_string(i) + (i < hardwareCount ? " (hardware)" : " (software)"),
                      .platform = "device",
                      .kind = EGL_PLATFORM_DEVICE_EXT,
                      .native = devices[i]});
  }
  return places;
}

} // namespace

const Result<EglApi>& eglApi() {
  static const Result<EglApi> api = openEgl();
  return api;
}

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

bool hasExtension(const char* extensions, std::string_view name) {
  if (!extensions) return false;
  const std::string list = " " + std::string(extensions) + " ";
  return list.find(" " + std::string(name) + " ") != std::string::npos;
}

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

Result<EGLDisplay> openDisplay(const EglApi& egl, const EglPlace& place) {
  const EGLDisplay display = egl.getPlatformDisplay(place.kind, place.native, nullptr);
  if (display == EGL_NO_DISPLAY) return backendProblem("no display (" + eglErrorName(egl) + ")");
  if (!egl.initialize(display, nullptr, nullptr)) {
    return backendProblem("eglInitialize failed (" + eglErrorName(egl) + ")");
  }
  return display;
}

} // namespace gnomon::gl
