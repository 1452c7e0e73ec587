#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/context.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

/// A library opened at run time. It is never closed: drivers leave threads and thread-local destructors behind, and the
/// function table points into it.
class SharedLibrary {
 public:
  /// Opens it with its symbols kept out of the global scope, since libOSMesa exports its own gl* symbols.
  explicit SharedLibrary(const char* name);

  bool isOpen() const { return handle_ != nullptr; }
  const std::string& failure() const { return failure_; }

  /// Null when it has no such function.
  template <class Function>
  void load(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  void* handle_ = nullptr;
  std::string failure_;
};

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

/// States what every context of ours begins with: clip depth 0..1 with the origin at the lower left, tightly packed
/// client texels, debug output into this thread's log. REQUIRES: current, with the function table loaded.
void setUpContext();

/// Asks the current context what it is.
RendererInfo describeContext(std::string backend, std::string platform);

/// Whether GL_RENDERER names one of the renderers that run on the CPU.
bool isSoftwareRenderer(const std::string& renderer);

/// What trying one back end gave: a context, or why each way to one failed.
struct Attempt {
  std::unique_ptr<Context> context;
  std::vector<std::string> failures; ///< "EGL device 0: ..." in the order tried
};

Attempt tryEgl(bool requireGpu);
Attempt tryOsmesa(bool requireGpu);

} // namespace gnomon::gl
