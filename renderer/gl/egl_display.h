#pragma once

#include <string>
#include <vector>

#include "renderer/gl/egl_api.h"

namespace gnomon::gl {

/// A place where EGL may make a context.
struct EglPlace {
  std::string name;     ///< for messages: "EGL device 0 (hardware)"
  std::string platform; ///< "device" | "surfaceless"
  EGLenum kind = 0;
  void* native = nullptr;
};

/// Every place that this EGL offers without a window system: devices, hardware before software, then surfaceless. Never
/// the default display, which may be X or Wayland. Empty when EGL knows neither platform.
std::vector<EglPlace> eglPlaces(const EglApi& egl);

/// An initialized display. EGL has one display for a place, however often it is asked, and contexts on other threads
/// may use it: it is never terminated.
Result<EGLDisplay> openDisplay(const EglApi& egl, const EglPlace& place);

} // namespace gnomon::gl
