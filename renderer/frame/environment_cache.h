#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/environment_options.h"
#include "renderer/environment/environment.h"
#include "renderer/environment/environment_file.h"

namespace gnomon {

/// Environments of earlier frames. The least recently used are dropped first once all take more than a budget, and
/// those of files that are in use nowhere else. Any thread; one that needs what is not there yet makes it, while others
/// find what is.
class EnvironmentCache {
 public:
  explicit EnvironmentCache(std::size_t budgetBytes = std::size_t{1} << 28) : budgetBytes_(budgetBytes) {}

  /// Made now if need be, from `split` where it was read just now; problems have no pointer. The newest stays,
  /// whatever its size.
  Result<std::shared_ptr<const Environment>> get(const std::shared_ptr<const EnvironmentFile>& file,
                                                 SunExtraction extraction, std::optional<SplitEnvironment> split = {});

  /// Computed now if need be. `sky`: its sun is settled.
  std::shared_ptr<const Environment> get(const Sky& sky);

 private:
  /// What it is made from: a file, or else a sky.
  struct Source {
    std::weak_ptr<const EnvironmentFile> file{};
    bool withSun = false; ///< in the picture
    std::optional<Sky> sky{};
  };
  struct Entry {
    Source source;
    std::shared_ptr<const Environment> environment;
  };

  std::shared_ptr<const Environment> kept(const Source& source);
  std::shared_ptr<const Environment> lookUp(const Source& source);
  std::shared_ptr<const Environment> keep(const Source& source, Environment made);

  std::size_t budgetBytes_;
  std::mutex mutex_;
  LruList<Entry> entries_;
};

} // namespace gnomon
