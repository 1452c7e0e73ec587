#include "renderer/gl/context.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>

#include "renderer/gl/backend_problem.h"
#include "renderer/gl/context_attempt.h"
#include "renderer/gl/cpu_quota.h"

namespace gnomon::gl {
namespace {

void setEnvironment() {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  std::ifstream in("/proc/self/cgroup");
  const std::string membership{std::istreambuf_iterator<char>(in), {}};
  const auto cores = coresGranted("/sys/fs/cgroup", membership);
  if (!cores || *cores >= std::thread::hardware_concurrency()) return;
  setenv("LP_NUM_THREADS", std::to_string(std::max(1, static_cast<int>(std::ceil(*cores)))).c_str(), 0);
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
