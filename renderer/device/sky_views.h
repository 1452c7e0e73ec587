#pragma once

#include "protocol/spec/debug_light.h"
#include "protocol/spec/traits.h"
#include "renderer/device/device.h"

namespace gnomon {

/// Whether a view shows what the scene hides of the frame's environment. `debugLight`: as in ShowInput.
inline bool showsSkyShadow(const FrameWork& work, const ViewRequest& request, int debugLight) {
  if (work.frame.spec.environment.shadows != EnvironmentShadows::rays) return false;
  if (request.view == View::shadow) return debugLight == kEnvironmentLight;
  return request.view != View::lightContribution && traitsOf(request.view).source == ViewSource::picture;
}

} // namespace gnomon
