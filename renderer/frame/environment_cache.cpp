#include "renderer/frame/environment_cache.h"

#include <utility>

#include "renderer/environment/make_environment.h"
#include "renderer/environment/sky_model.h"

namespace gnomon {

/// With the mutex held.
std::shared_ptr<const Environment> EnvironmentCache::kept(const Source& source) {
  const Entry* const found = entries_.findIf([&](const Entry& entry) {
    const Source& own = entry.source;
    return own.file.lock() == source.file.lock() && own.withSun == source.withSun && own.sky == source.sky;
  });
  return found ? found->environment : nullptr;
}

std::shared_ptr<const Environment> EnvironmentCache::lookUp(const Source& source) {
  const std::lock_guard lock(mutex_);
  return kept(source);
}

std::shared_ptr<const Environment> EnvironmentCache::keep(const Source& source, Environment made) {
  auto shared = std::make_shared<const Environment>(std::move(made));
  const std::lock_guard lock(mutex_);
  if (auto found = kept(source)) return found; // another thread was faster: all share what it made
  entries_.add({source, shared});
  entries_.eraseIf([](const Entry& entry) { return !entry.source.sky && entry.source.file.expired(); });
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return bytesIn(*entry.environment); });
  return shared;
}

Result<std::shared_ptr<const Environment>> EnvironmentCache::get(const std::shared_ptr<const EnvironmentFile>& file,
                                                                 SunExtraction extraction,
                                                                 std::optional<SplitEnvironment> split) {
  const Source source{.file = file, .withSun = extraction == SunExtraction::none};
  if (auto found = lookUp(source)) return found;
  if (!split) {
    auto read = file->read(extraction);
    if (!read) return read.problems();
    split = *std::move(read);
  }
  return keep(source, makeEnvironment(std::move(split->map), split->facts.sun));
}

std::shared_ptr<const Environment> EnvironmentCache::get(const Sky& sky) {
  const Source source{.sky = sky};
  if (auto found = lookUp(source)) return found;
  return keep(source, makeEnvironment(skyMap(sky), sunOf(sky)));
}

} // namespace gnomon
