#include "renderer/frame/environment_cache.h"

#include "renderer/environment/make_environment.h"
#include "renderer/environment/read_environment.h"

namespace gnomon {

Result<std::shared_ptr<const Environment>> EnvironmentCache::get(const std::shared_ptr<const Bytes>& file,
                                                                 SunExtraction extraction) {
  const Entry* const found =
      entries_.findIf([&](const Entry& entry) { return entry.extraction == extraction && entry.file.lock() == file; });
  if (found) return found->environment;
  auto map = readEnvironment(*file);
  if (!map) return map.problems();
  const Entry& added = entries_.add(
      {file, extraction, std::make_shared<const Environment>(makeEnvironment(*std::move(map), extraction))});
  entries_.eraseIf([](const Entry& entry) { return entry.file.expired(); });
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return bytesIn(*entry.environment); });
  return added.environment;
}

} // namespace gnomon
