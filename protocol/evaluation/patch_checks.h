#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

/// Checks of a request's own FrameSpec, at /spec, and of merge patches over it.
namespace gnomon {

/// The same problems, seen from the document that `place` is in.
Problems within(Problems problems, const std::string& place);

/// Adds a problem for each null of a patch that takes away what no spec has: it leaves nothing behind that the decoder
/// could find fault with.
void checkRemovals(const Json& patch, ProblemList& problems);

/// Adds the rules across fields that the request's spec breaks, but for what its known problems explain.
void checkSpecRules(const FrameSpec& spec, ProblemList& problems);

/// The request's spec as it was written; {} where it is no object.
Json writtenSpec(const Json& request);

/// Adds the problems of a patched spec, which came from `place`, but for those that the request's own spec has among
/// `known`.
void addPatchProblems(const Problems& found, const Problems& known, const std::string& place, ProblemList& problems);

} // namespace gnomon
