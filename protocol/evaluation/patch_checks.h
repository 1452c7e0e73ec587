#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

/// Checks of merge patches over a FrameSpec.
namespace gnomon {

/// The same problems, seen from the document that `place` is in.
Problems within(Problems problems, const std::string& place);

/// Adds a problem for each null of a patch that takes away what no spec has: it leaves nothing behind that the decoder
/// could find fault with.
void checkRemovals(const Json& patch, ProblemList& problems);

} // namespace gnomon
