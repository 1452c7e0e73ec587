#pragma once

#include "protocol/base/problem_list.h"
#include "protocol/base/result.h"
#include "protocol/json/json_source.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// A FrameSpec from a tree, however that was read; `problems` are those of the reading.
Result<FrameSpec> decodeFrameTree(const JsonNode& root, ProblemList problems);

} // namespace gnomon
