#include "renderer/frame/environment_cache.h"

#include <utility>

#include "renderer/environment/make_environment.h"
#include "renderer/environment/sky_model.h"

namespace gnomon {

Result<std::shared_ptr<const Environment>> EnvironmentCache::get(const std::shared_ptr<const EnvironmentFile>& file,
                                                                 SunExtraction extraction,
                                                                 std::optional<SplitEnvironment> split) {
  const bool withSun = extraction == SunExtraction::none;
  const Entry* const found =
      entries_.findIf([&](const Entry& entry) { return entry.withSun == withSun && entry.file.lock() == file; });
  if (found) return found->environment;
  if (!split) {
    auto read = file->read(extraction);
    if (!read) return read.problems();
    split = *std::move(read);
  }
  const Entry& added = entries_.add(
      {file, withSun, std::make_shared<const Environment>(makeEnvironment(std::move(split->map), split->facts.sun))});
  entries_.eraseIf([](const Entry& entry) { return entry.file.expired(); });
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return bytesIn(*entry.environment); });
  return added.environment;
}

std::shared_ptr<const Environment> EnvironmentCache::get(const Sky& sky) {
  constexpr std::size_t kMostSkies = 8; // of 1.5 MB; a day of the sun needs another one each frame
  if (const SkyEntry* found = skies_.find(sky, &SkyEntry::sky)) return found->environment;
  const SkyEntry& added = skies_.add({sky, std::make_shared<const Environment>(skyEnvironment(sky))});
  skies_.keepNewest(kMostSkies);
  return added.environment;
}

} // namespace gnomon
