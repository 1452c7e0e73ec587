#include "server/scenes/store_quota.h"

#include <algorithm>

namespace gnomon {

Problem noRoom(std::uint64_t quota, std::uint64_t taken, std::uint64_t bytes) {
  return {ProblemCode::insufficientStorage, "",
          "The scene store has no room for this scene (--store-bytes). Delete scenes, or have more room.",
          std::to_string(quota) + " bytes",
          std::to_string(taken) + " bytes are taken, and these are " + std::to_string(bytes)};
}

/// With the mutex held, which only uploads and removals take.
Status StoreQuota::room(std::uint64_t bytes) {
  constexpr int kShare = 20;
  if (const auto begun = Clock::now(); begun >= countAgain_) {
    kept_ = count_(unfinished_);
    const auto ended = Clock::now();
    countAgain_ = ended + kShare * (ended - begun);
  }
  const std::uint64_t used = kept_ + writing_;
  if (used <= bytes_ && bytes <= bytes_ - used) return Done{};
  return noRoom(bytes_, used, bytes);
}

Status StoreQuota::check(std::uint64_t bytes) {
  if (bytes_ == 0) return Done{};
  const std::lock_guard lock(mutex_);
  return room(bytes);
}

Status StoreQuota::write(const std::string& id, std::uint64_t bytes, const std::function<Status()>& write) {
  if (bytes_ == 0) return write();
  {
    const std::lock_guard lock(mutex_);
    if (Status fits = room(bytes); !fits) return fits;
    writing_ += bytes;
    unfinished_.insert(id);
  }
  Status written = write();
  const std::lock_guard lock(mutex_);
  writing_ -= bytes;
  unfinished_.erase(unfinished_.find(id));
  if (written && !unfinished_.contains(id)) kept_ += bytes; // the last one of several that write the same
  return written;
}

void StoreQuota::giveBack(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  kept_ -= std::min(kept_, bytes);
}

} // namespace gnomon
