#pragma once

#include "server/process/serve.h"

namespace CLI {
class App;
}

namespace gnomon {

/// Every choice of ServeOptions as a flag and as an environment variable of the command. `options` must outlive the
/// parsing; its values are the defaults.
void addServeFlags(CLI::App& command, ServeOptions& options);

} // namespace gnomon
