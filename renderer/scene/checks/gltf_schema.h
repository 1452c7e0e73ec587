#pragma once

#include <nlohmann/json.hpp>

#include "renderer/scene/findings.h"

namespace gnomon {

/// Checks every member of the glTF that Gnomon reads: its presence, type and range, and that each index names
/// something that exists. Integral numbers written as 3.0 become 3. Members that are not read are left alone.
/// What is repaired is as repaired afterwards: a number that was rounded beyond its limit is at the limit, a value of
/// no list is gone, and in the place of an accessor, buffer, camera, light or animation that is left out stands an
/// array of the reason and its name (faultOf in document/gltf_json.h). What needs the buffers or several members at
/// once is checked elsewhere.
void checkSchema(nlohmann::json& document, Findings& findings);

} // namespace gnomon
