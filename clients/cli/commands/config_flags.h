#pragma once

namespace CLI {
class App;
}

namespace gnomon::cli {

/// --preset, --config, --no-config and --show-config, for a command that draws or calls a server.
void addConfigFlags(CLI::App& command);

} // namespace gnomon::cli
