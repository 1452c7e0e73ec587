#pragma once

#include <string>

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

} // namespace gnomon::gl
