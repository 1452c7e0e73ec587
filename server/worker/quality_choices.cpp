#include "server/worker/quality_choices.h"

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

std::string hashOf(const std::string& key) {
  Sha256 hash;
  hash.add(key);
  return hash.hex();
}

} // namespace

std::optional<QualityReport> QualityChoices::find(const std::string& key) {
  const std::string hash = hashOf(key);
  const std::lock_guard lock(mutex_);
  const Entry* const found = entries_.find(hash, &Entry::hash);
  return found ? std::optional(found->report) : std::nullopt;
}

void QualityChoices::keep(const std::string& key, const QualityReport& report) {
  const std::string hash = hashOf(key);
  const std::lock_guard lock(mutex_);
  entries_.eraseIf([&](const Entry& entry) { return entry.hash == hash; });
  entries_.add({hash, report});
  entries_.keepNewest(kMost);
}

} // namespace gnomon
