#pragma once

#include <string>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/spec/spec_arguments.h"
#include "renderer/render.h"

namespace CLI {
class App;
}

/// The flags that `render` and `plan` share. What they fill in outlives the command.
namespace gnomon::cli {

/// Where the work is done.
struct WhereOptions {
  std::string server;  ///< empty = in this process
  std::string keyFile; ///< whose first line is the secret that `server` is shown; empty = GNOMON_KEY
  BackendOptions backend;
};

void addPictureFlags(CLI::App& command, SpecArguments& arguments);
/// The server, with the key to show it: from the file, or from the environment's GNOMON_KEY. A command line is seen by
/// other users of the machine, so no flag takes a key.
Result<Remote> remoteOf(const WhereOptions& where);

void addWhereFlags(CLI::App& command, WhereOptions& where);

} // namespace gnomon::cli
