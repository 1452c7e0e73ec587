#pragma once

#include <cstddef>
#include <vector>

#include "protocol/spec/camera.h"
#include "protocol/spec/light.h"
#include "protocol/spec/validate.h"

namespace gnomon {

/// Rules across the fields of the camera, at "/camera".
/// One of index and name, and a time only with them.
void appendAnimationRules(const AnimationMoment& moment, std::vector<BrokenRule>& broken);
void appendCameraRules(const Camera& camera, std::vector<BrokenRule>& broken);

/// Rules across the fields of a light, at "/lights/<index>". Its shadow's own rules are elsewhere.
void appendLightRules(const Light& light, std::size_t index, std::vector<BrokenRule>& broken);

} // namespace gnomon
