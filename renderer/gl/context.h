#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "protocol/report/replies.h"

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

/// Sets, where they are unset, the variables that Mesa reads: LP_NUM_THREADS to the cores that the control group grants
/// where these are fewer than the machine's (Mesa sees only the machine's), and MESA_SHADER_CACHE_DISABLE. Once a
/// process; createContext calls it. A program with threads calls it before it starts them: the environment is not safe
/// to change while another thread reads it.
void prepareEnvironment();

/// The first context that works. When none does, one problem names everything that was tried.
Result<std::unique_ptr<Context>> createContext(const BackendOptions& options);

} // namespace gnomon::gl
