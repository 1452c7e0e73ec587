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

/// An initialized display. EGL gives one display for a place, however often it is asked: it is terminated with its
/// last user in the process.
class EglDisplay {
 public:
  static Result<EglDisplay> open(const EglApi& egl, const EglPlace& place);
  EglDisplay(EglDisplay&& other) noexcept;
  EglDisplay& operator=(EglDisplay&&) = delete;
  ~EglDisplay();

  EGLDisplay get() const { return display_; }

 private:
  EglDisplay(const EglApi& egl, EGLDisplay display) : egl_(&egl), display_(display) {}

  const EglApi* egl_;
  EGLDisplay display_;
};

} // namespace gnomon::gl
