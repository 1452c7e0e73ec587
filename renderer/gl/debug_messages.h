#pragma once

namespace gnomon::gl {

/// Sends the current context's debug messages to this thread's log (debug_log.h), which it empties.
void recordDebugMessages();

} // namespace gnomon::gl
