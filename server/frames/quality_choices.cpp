#include "server/frames/quality_choices.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t kMostChoices = 1024; ///< a few kilobytes each

} // namespace

std::optional<QualityReport> QualityChoices::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) {
    return std::nullopt;
  }
  entries_.splice(entries_.begin(), entries_, found);
  return found->report;
}

void QualityChoices::keep(const std::string& key, const QualityReport& report) {
  const std::lock_guard lock(mutex_);
  entries_.remove_if([&](const Entry& entry) { return entry.key == key; });
  entries_.push_front({key, report});
  if (entries_.size() > kMostChoices) {
    entries_.pop_back();
  }
}

} // namespace gnomon
