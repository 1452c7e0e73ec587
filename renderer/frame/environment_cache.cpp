#include "renderer/frame/environment_cache.h"

#include <utility>

#include "renderer/environment/make_environment.h"
#include "renderer/environment/sky_model.h"

namespace gnomon {

/// With the mutex held, as the next one.
std::shared_ptr<const Environment> EnvironmentCache::kept(const std::shared_ptr<const EnvironmentFile>& file,
                                                          bool withSun) {
  const Entry* const found =
      entries_.findIf([&](const Entry& entry) { return entry.withSun == withSun && entry.file.lock() == file; });
  return found ? found->environment : nullptr;
}

std::shared_ptr<const Environment> EnvironmentCache::kept(const Sky& sky) {
  const SkyEntry* const found = skies_.find(sky, &SkyEntry::sky);
  return found ? found->environment : nullptr;
}

Result<std::shared_ptr<const Environment>> EnvironmentCache::get(const std::shared_ptr<const EnvironmentFile>& file,
                                                                 SunExtraction extraction,
                                                                 std::optional<SplitEnvironment> split) {
  const bool withSun = extraction == SunExtraction::none;
  std::unique_lock lock(mutex_);
  if (auto found = kept(file, withSun)) return found;
  lock.unlock();
  if (!split) {
    auto read = file->read(extraction);
    if (!read) return read.problems();
    split = *std::move(read);
  }
  auto made = std::make_shared<const Environment>(makeEnvironment(std::move(split->map), split->facts.sun));
  lock.lock();
  if (auto found = kept(file, withSun)) return found; // another thread was faster: all share what it made
  entries_.add({file, withSun, made});
  entries_.eraseIf([](const Entry& entry) { return entry.file.expired(); });
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return bytesIn(*entry.environment); });
  return made;
}

std::shared_ptr<const Environment> EnvironmentCache::get(const Sky& sky) {
  constexpr std::size_t kMostSkies = 8; // of 1.5 MB; a day of the sun needs another one each frame
  std::unique_lock lock(mutex_);
  if (auto found = kept(sky)) return found;
  lock.unlock();
  auto made = std::make_shared<const Environment>(makeEnvironment(skyMap(sky), sunOf(sky)));
  lock.lock();
  if (auto found = kept(sky)) return found;
  skies_.add({sky, made});
  skies_.keepNewest(kMostSkies);
  return made;
}

} // namespace gnomon
