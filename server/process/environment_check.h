#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Whether a variable is one that Kubernetes and Docker set for a service of this name or one that begins with it:
/// GNOMON_SERVICE_HOST, GNOMON_SERVICE_PORT, GNOMON_SERVICE_PORT_HTTP, GNOMON_PORT=tcp://10.0.0.1:8080,
/// GNOMON_PORT_8080_TCP, GNOMON_PORT_8080_TCP_ADDR; of a service gnomon-canary GNOMON_CANARY_SERVICE_HOST and so on.
bool isServiceVariable(std::string_view name, std::string_view value);

/// What is wrong with the variables whose names begin with GNOMON_: a sentence for each that is neither `known` nor a
/// service's nor the Python client's, with the known one that may have been meant. `environment`: entries as
/// NAME=VALUE.
std::vector<std::string> unknownVariables(std::span<const std::string> environment, std::span<const std::string> known);

/// The entries of this process.
std::vector<std::string> ownEnvironment();

} // namespace gnomon
