#include "renderer/gl/context.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

#include "renderer/core/parallel.h"
#include "renderer/gl/context_setup.h"
#include "renderer/gl/debug_log.h"

namespace gnomon::gl {
namespace {

void setEnvironment() {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  const int cores = coresToUse();
  if (cores >= static_cast<int>(std::thread::hardware_concurrency())) return;
  setenv("LP_NUM_THREADS", std::to_string(cores).c_str(), 0);
}

} // namespace

void prepareEnvironment() {
  static std::once_flag once;
  std::call_once(once, setEnvironment);
}

Result<std::unique_ptr<Context>> createContext(const BackendOptions& options) {
  prepareEnvironment();
  std::vector<std::string> failures;
  const auto attempt = [&](Attempt (*make)(bool)) {
    Attempt made = make(options.requireGpu);
    failures.insert(failures.end(), made.failures.begin(), made.failures.end());
    return std::move(made.context);
  };
  if (options.backend != Backend::osmesa) {
    if (auto context = attempt(tryEgl)) return context;
  }
  if (options.backend != Backend::egl) {
    if (auto context = attempt(tryOsmesa)) return context;
  }
  std::string detail = "no graphics context could be made";
  for (std::size_t i = 0; i < failures.size(); ++i) detail += (i == 0 ? ": " : "; ") + failures[i];
  return backendProblem(detail + ".");
}

} // namespace gnomon::gl
