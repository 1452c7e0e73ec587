#pragma once

#include "renderer/cpu/cpu_device.h"
#include "renderer/passes/gl_device.h"
#include "renderer/render.h"
#include "tests/support/tested_device.h"

namespace gnomon::testing {

/// A renderer by the tested device that keeps no tiles, so that counts don't depend on other cases.
inline Result<Renderer> uncachedRenderer() {
  auto device = testedDevice() == DeviceChoice::cpu ? createCpuDevice({.tileBytes = 0})
                                                    : createGlDevice({.backend = {}, .tileBytes = 0});
  if (!device) return device.problems();
  return Renderer(std::move(*device));
}

} // namespace gnomon::testing
