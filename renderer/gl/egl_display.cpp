#include "renderer/gl/egl_display.h"

#include <algorithm>

#include "renderer/gl/backend_problem.h"

namespace gnomon::gl {
namespace {

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
