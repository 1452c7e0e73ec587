#pragma once

#include <string_view>

#include "protocol/base/result.h"
#include "renderer/gl/gl.h"

namespace gnomon::gl {

/// One user of the process-wide function table. While there is one, every other must come from the same back end,
/// whose functions are then the same for every thread.
class FunctionTable {
 public:
  /// Loads the table, with a context current, unless it is loaded. A problem where another back end uses it, where the
  /// thread has a context already, or where the context is older than OpenGL 4.5.
  static Result<FunctionTable> load(std::string_view backend, GLADloadfunc getProcAddress);
  FunctionTable(FunctionTable&& other) noexcept;
  FunctionTable& operator=(FunctionTable&&) = delete;
  ~FunctionTable();

 private:
  FunctionTable() = default;
  bool used_ = true;
};

/// Why this thread can't take a context of that back end now; empty = it can. Asked before making one current.
std::string_view tableConflict(std::string_view backend);

} // namespace gnomon::gl
