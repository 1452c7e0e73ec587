#pragma once

#include "protocol/spec/traits.h"
#include "renderer/device/device.h"

namespace gnomon {

/// Whether a view shows what the scene hides of the frame's environment.
inline bool showsSkyShadow(const FrameWork& work, const ViewRequest& request) {
  const FrameSpec& spec = work.frame.spec;
  return spec.environment.shadows == EnvironmentShadows::rays && request.view != View::lightContribution &&
         traitsOf(request.view).source == ViewSource::picture;
}

} // namespace gnomon
