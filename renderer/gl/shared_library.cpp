#include "renderer/gl/shared_library.h"

#include <dlfcn.h>

namespace gnomon::gl {

SharedLibrary::SharedLibrary(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
  if (handle_) return;
  const char* error = dlerror();
  failure_ = error ? error : name;
}

void* SharedLibrary::symbol(const char* name) const {
  return handle_ ? dlsym(handle_, name) : nullptr;
}

} // namespace gnomon::gl
