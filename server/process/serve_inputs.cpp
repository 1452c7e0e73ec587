#include "server/process/serve_inputs.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "server/handlers/drake_form.h"
#include "server/process/stores.h"
#include "server/redis/stream.h"

namespace gnomon {
namespace {

bool listensOnAll(const std::string& bind) {
  return bind == "0.0.0.0" || bind == "::";
}

/// Of a size that can't be used, since another is smaller.
std::string moreThan(const char* name, std::uint64_t bytes, const char* other, std::uint64_t otherBytes) {
  return std::string("--") + name + " (" + std::to_string(bytes) + ") is more than --" + other + " (" +
         std::to_string(otherBytes) + "): the largest scenes would always be refused.";
}

/// Adds faults of one option, which its detail begins with.
class FaultsOf {
 public:
  FaultsOf(std::string_view option, std::vector<OptionFault>& faults) : option_(option), faults_(faults) {}

  void add(std::string detail) {
    faults_.push_back({{option_}, "--" + std::string(option_) + ": " + std::move(detail)});
  }

  void add(const Problems& problems) {
    for (const Problem& problem : problems) {
      add((problem.pointer.starts_with('/') ? problem.pointer + ": " : "") + problem.detail +
          (problem.actual.empty() ? "" : " (" + problem.actual + ")"));
    }
  }

 private:
  std::string_view option_;
  std::vector<OptionFault>& faults_;
};

/// The spec for Drake's color pictures.
FrameSpec drakeColors(const std::string& file, FaultsOf faults) {
  if (file.empty()) return drakeDefaults();
  std::ifstream stream(file, std::ios::binary);
  std::string text(kLimits.maxSpecBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.empty() || text.size() > kLimits.maxSpecBytes) {
    faults.add("The file " + file + " can't be read, is empty, or is larger than a spec may be.");
    return {};
  }
  const auto spec = readDrakeSpec(text);
  if (spec) return *spec;
  faults.add(spec.problems());
  return {};
}

/// A problem on one line.
std::string sentence(const Problem& problem) {
  if (problem.limit.empty()) return problem.detail;
  return problem.detail.substr(0, problem.detail.find_last_not_of('.') + 1) + ": " + problem.limit + ".";
}

/// The address of a Redis that an option names.
std::optional<redis::Address> redisOf(const ServeOptions& options, const std::string& text, FaultsOf faults) {
  auto address = redis::parseAddress(text);
  if (!address) {
    faults.add(sentence(address.problems().front()));
    return std::nullopt;
  }
  if (!options.redisPasswordFile.empty() && !address->password.empty())
    faults.add("Its address has a password, and --redis-password-file, too.");
  if (!options.redisAuthorities.empty() && !address->isEncrypted)
    faults.add("--redis-authorities is about TLS: the address has to begin with rediss://.");
  address->authorities = options.redisAuthorities;
  return *std::move(address);
}

} // namespace

std::vector<OptionFault> conflictsOf(const ServeOptions& options) {
  std::vector<OptionFault> faults;
  const auto refuse = [&](bool holds, std::vector<std::string_view> names, std::string detail) {
    if (holds) faults.push_back({std::move(names), std::move(detail)});
  };
  const bool isProcessor = options.device == DeviceChoice::cpu;
  refuse(isProcessor && options.requireGpu, {"require-gpu", "device"},
         "--require-gpu asks for a GPU, and --device cpu uses none: leave one of the two out.");
  refuse(isProcessor && options.backend != Backend::auto_, {"backend", "device"},
         "--backend chooses OpenGL's context, and --device cpu uses none: leave one of the two out.");
  refuse(!options.adminPort && options.adminBind != ServeOptions{}.adminBind, {"admin-bind", "admin-port"},
         "--admin-bind is an address of --admin-port, which is not set.");
  const bool isOnePlace =
      options.bind == options.adminBind || listensOnAll(options.bind) || listensOnAll(options.adminBind);
  refuse(options.adminPort.value_or(0) != 0 && *options.adminPort == options.port && isOnePlace, {"admin-port", "port"},
         "--admin-port is the port of --port: each needs its own.");

  const std::string stored = " is about scenes that are stored: --store has to name a directory or Redis.";
  refuse(options.store.empty() && options.storeBytes > 0, {"store-bytes", "store"}, "--store-bytes" + stored);
  refuse(options.store.empty() && options.storeAgeSeconds > 0, {"store-age", "store"}, "--store-age" + stored);
  const bool isRedis = redis::isAddress(options.store) || !options.jobsAddress.empty();
  const std::string remote = " needs a --store or --jobs that is Redis.";
  refuse(!isRedis && !options.redisPasswordFile.empty(), {"redis-password-file", "store", "jobs"},
         "--redis-password-file" + remote);
  refuse(!isRedis && !options.redisAuthorities.empty(), {"redis-authorities", "store", "jobs"},
         "--redis-authorities" + remote);
  refuse(!options.jobsAddress.empty() && options.store.empty(), {"jobs", "store"},
         "Jobs of --jobs are drawn by every server that names it: --store has to name what they share.");

  const std::uint64_t largest = options.maxSceneBytes;
  refuse(largest > options.uploadMemoryBytes, {"max-scene-bytes", "upload-memory-bytes"},
         moreThan("max-scene-bytes", largest, "upload-memory-bytes", options.uploadMemoryBytes));
  refuse(keepsScenesInMemory(options) && largest > options.bundleMemoryBytes,
         {"max-scene-bytes", "bundle-memory-bytes"},
         moreThan("max-scene-bytes", largest, "bundle-memory-bytes", options.bundleMemoryBytes));
  refuse(options.storeBytes > 0 && largest > options.storeBytes, {"max-scene-bytes", "store-bytes"},
         moreThan("max-scene-bytes", largest, "store-bytes", options.storeBytes));
  return faults;
}

ServeInputs readAddresses(const ServeOptions& options, std::vector<OptionFault>& faults) {
  ServeInputs inputs;
  auto proxies = ipNetworks(options.trustedProxies);
  if (proxies) {
    inputs.trustedProxies = *std::move(proxies);
  } else {
    for (const Problem& each : proxies.problems()) {
      FaultsOf("trusted-proxies", faults).add(each.actual + ": " + sentence(each));
    }
  }
  if (redis::isAddress(options.store)) {
    inputs.store = redisOf(options, options.store, {"store", faults});
  } else if (options.store.find("://") != std::string::npos) {
    FaultsOf("store", faults).add("It is neither a directory nor an address that begins with redis:// or rediss://.");
  }
  if (!options.jobsAddress.empty()) inputs.jobs = redisOf(options, options.jobsAddress, {"jobs", faults});
  return inputs;
}

void readFiles(const ServeOptions& options, ServeInputs& inputs, std::vector<OptionFault>& faults) {
  if (!options.keysFile.empty()) {
    auto opened = KeyRing::open(options.keysFile);
    if (opened)
      inputs.keys = *std::move(opened);
    else
      FaultsOf("keys", faults).add(opened.problems());
  }
  inputs.drakeColors = drakeColors(options.drakeSpecFile, {"drake-spec", faults});
  if (!options.redisPasswordFile.empty()) {
    const auto password = redis::passwordFrom(options.redisPasswordFile);
    if (!password) FaultsOf("redis-password-file", faults).add(password.problems());
    for (auto* address : {&inputs.store, &inputs.jobs}) {
      if (password && *address) (*address)->password = *password;
    }
  }
  if (const std::string& file = options.redisAuthorities; !file.empty() && !redis::hasAuthorities(file))
    FaultsOf("redis-authorities", faults).add("The file " + file + " has no certificate, or can't be read.");
  if (::access(options.workerProgram.c_str(), X_OK) != 0)
    FaultsOf("worker-program", faults)
        .add(options.workerProgram + " can't be executed: " + std::generic_category().message(errno) + ".");
}

} // namespace gnomon
