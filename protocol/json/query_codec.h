#pragma once

#include <string>
#include <utility>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// A FrameSpec from a decoded query string, as strictly as decodeFrameSpec: keys are fields' paths
/// ("camera.orbit.azimuthDegrees", "lights[0].intensity"; see field_path.h) in any order, values are JSON or bare
/// words; short forms: sun=AZIMUTH,ELEVATION; view=NAME; format=png. Pointers name the query key.
Result<FrameSpec> decodeFrameQuery(const std::vector<std::pair<std::string, std::string>>& query);

} // namespace gnomon
