#pragma once

#include <cstdlib>
#include <string_view>

#include "protocol/report/replies.h"
#include "protocol/spec/output_options.h"

namespace gnomon::testing {

/// The device by which tests of pictures draw: OpenGL, unless GNOMON_TEST_DEVICE is `cpu`.
inline DeviceChoice testedDevice() {
  const char* name = std::getenv("GNOMON_TEST_DEVICE");
  return name != nullptr && std::string_view(name) == "cpu" ? DeviceChoice::cpu : DeviceChoice::gl;
}

inline BackendOptions testedBackend() {
  return {.device = testedDevice()};
}

/// What cases say that GTEST_SKIP for want of OpenGL: `GNOMON_NEEDS_GL("shadow volumes are OpenGL's")`.
#define GNOMON_NEEDS_GL(reason) \
  if (::gnomon::testing::testedDevice() != ::gnomon::DeviceChoice::gl) GTEST_SKIP() << (reason)

} // namespace gnomon::testing
