#pragma once

#include <optional>
#include <string>

namespace gnomon {

/// The client's id if it is 1..128 letters, digits or -._: (nothing that could forge a log line); else a new one.
std::string requestId(const std::optional<std::string>& offered);

} // namespace gnomon
