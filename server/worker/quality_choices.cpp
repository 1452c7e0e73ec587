#include "server/worker/quality_choices.h"

#include <algorithm>

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
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.hash == hash; });
  if (found == entries_.end()) return std::nullopt;
  entries_.splice(entries_.begin(), entries_, found);
  return found->report;
}

void QualityChoices::keep(const std::string& key, const QualityReport& report) {
  const std::string hash = hashOf(key);
  const std::lock_guard lock(mutex_);
  entries_.remove_if([&](const Entry& entry) { return entry.hash == hash; });
  entries_.push_front({hash, report});
  if (entries_.size() > kMost) entries_.pop_back();
}

} // namespace gnomon
