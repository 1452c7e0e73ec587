#include "renderer/gl/function_table.h"

#include <dlfcn.h>
#include <mutex>
#include <string>
#include <utility>

#include "renderer/gl/debug_log.h"

namespace gnomon::gl {
namespace {

std::mutex tableMutex;
std::string tableBackend; // of the users
int tableUsers = 0;
thread_local bool threadHasContext = false;

} // namespace

SharedLibrary::SharedLibrary(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
  if (handle_) return;
  const char* error = dlerror();
  failure_ = error ? error : name;
}

void* SharedLibrary::symbol(const char* name) const {
  return handle_ ? dlsym(handle_, name) : nullptr;
}

std::string_view tableConflict(std::string_view backend) {
  if (threadHasContext) return "this thread already has a graphics context";
  const std::lock_guard lock(tableMutex);
  if (tableUsers > 0 && tableBackend != backend) return "this process already uses another back end";
  return {};
}

Result<FunctionTable> FunctionTable::load(std::string_view backend, GLADloadfunc getProcAddress) {
  if (const std::string_view conflict = tableConflict(backend); !conflict.empty()) {
    return backendProblem(std::string(conflict));
  }
  const std::lock_guard lock(tableMutex);
  if (tableUsers == 0) {
    const int version = gladLoadGL(getProcAddress);
    if (version < GLAD_MAKE_VERSION(4, 5)) {
      return backendProblem("the driver has OpenGL " + std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                            std::to_string(GLAD_VERSION_MINOR(version)) + " only, not 4.5");
    }
    tableBackend = backend;
  } else if (tableBackend != backend) {
    return backendProblem("this process already uses another back end");
  }
  ++tableUsers;
  threadHasContext = true;
  return FunctionTable();
}

FunctionTable::FunctionTable(FunctionTable&& other) noexcept : used_(std::exchange(other.used_, false)) {}

FunctionTable::~FunctionTable() {
  if (!used_) return;
  const std::lock_guard lock(tableMutex);
  --tableUsers;
  threadHasContext = false;
}

} // namespace gnomon::gl
