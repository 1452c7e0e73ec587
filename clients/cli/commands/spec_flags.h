#pragma once

#include <string>

#include "clients/cli/spec/spec_arguments.h"
#include "renderer/render.h"

namespace CLI {
class App;
}

/// The flags that `render` and `plan` share. What they fill in outlives the command.
namespace gnomon::cli {

/// Where the work is done.
struct WhereOptions {
  std::string server; ///< empty = in this process
  BackendOptions backend;
};

void addPictureFlags(CLI::App& command, SpecArguments& arguments);
void addWhereFlags(CLI::App& command, WhereOptions& where);

} // namespace gnomon::cli
