#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::gl {

Problem backendProblem(std::string detail);

/// Sends the current context's debug messages to this thread's log, which it empties.
void recordDebugMessages();

/// What the driver complained of on this thread since the last call: errors, undefined behaviour and everything of
/// high severity, and the pending glGetError codes. At most 64 messages are kept; a last line counts the rest.
/// Shader compiler messages are left out: Program returns them.
std::vector<std::string> takeDebugErrors();

/// A backend problem that names `doing` and every complaint since the last call; done when there was none.
Status checkErrors(std::string_view doing);

} // namespace gnomon::gl
