#pragma once

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::gl {

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

/// The process's libEGL.so.1, opened at the first call; a problem that says why it can't be.
const Result<EglApi>& eglApi();

/// The name of the last EGL error of this thread, e.g. "EGL_BAD_MATCH".
std::string eglErrorName(const EglApi& egl);

/// Whether a list separated by spaces has the name; a null list has none.
bool hasExtension(const char* extensions, std::string_view name);

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
