#pragma once

#include <memory>

#include "protocol/capabilities.h"
#include "protocol/result.h"

namespace gnomon::gl {

/// An OpenGL 4.5 core context without a window. Current on the thread that made it, and on no other; the
/// function table (glad) is loaded from it. Destroy it on that thread.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  const RendererInfo& info() const { return info_; }

 protected:
  Context() = default;
  RendererInfo info_;
};

/// The first context that works. When none does, one problem names everything that was tried.
Result<std::unique_ptr<Context>> createContext(const BackendOptions& options);

} // namespace gnomon::gl
