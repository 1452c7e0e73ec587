#include "server/scenes/memory_backend.h"

namespace gnomon {

Result<bool> MemoryBackend::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes,
                                const std::string& summary) {
  return scenes_.put(id, std::move(bundle), bytes, summary);
}

Result<StoredBundle> MemoryBackend::bundle(const std::string& id) {
  BundlePtr file = scenes_.bundle(id);
  if (!file) return unknownScene(id);
  return StoredBundle{std::move(file), false};
}

Status MemoryBackend::contains(const std::string& id) {
  if (!scenes_.contains(id)) return unknownScene(id);
  return Done{};
}

Status MemoryBackend::use(const std::string& id) {
  if (scenes_.bundle(id) == nullptr) return unknownScene(id);
  return Done{};
}

Status MemoryBackend::remove(const std::string& id) {
  if (!scenes_.remove(id)) return unknownScene(id);
  return Done{};
}

} // namespace gnomon
