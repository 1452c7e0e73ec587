#pragma once

#include "protocol/frame_spec.h"
#include "protocol/json_source.h"
#include "protocol/problem_list.h"
#include "protocol/result.h"

namespace gnomon {

/// A FrameSpec from a tree, however that was read; `problems` are those of the reading.
Result<FrameSpec> decodeFrameTree(const JsonNode& root, ProblemList problems);

} // namespace gnomon
