#pragma once

#include <string_view>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

/// The body of application/problem+json (RFC 9457): {type, title, status, detail, instance, problems: [{code, pointer,
/// detail, limit?, actual?}]}. Type and title are the first problem's; `status` is the caller's choice; an empty
/// `instance` is left out. Bytes that are not UTF-8 are replaced. `problems` is not empty.
Json problemJson(const Problems& problems, int status, std::string_view instance);

std::string_view problemName(ProblemCode code);  ///< "invalidValue"
std::string_view problemTitle(ProblemCode code); ///< "Invalid Value"

/// The schema of that body.
Json problemSchema();

} // namespace gnomon
