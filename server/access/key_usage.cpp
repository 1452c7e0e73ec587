#include "server/access/key_usage.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gnomon {

int KeyUsage::wait(const AccessKey& key, Clock::time_point now) {
  const std::lock_guard lock(*mutex_);
  return waitOf(key, refilled(key, now));
}

Admission KeyUsage::admit(const AccessKey& key, Clock::time_point now) {
  const std::lock_guard lock(*mutex_);
  Share& share = refilled(key, now);
  if (const int seconds = waitOf(key, share); seconds > 0) return {nullptr, seconds};
  std::shared_ptr<void> place(&share, [mutex = mutex_, held = shares_[key.name]](void*) {
    const std::lock_guard giving(*mutex);
    --held->running;
  });
  ++share.running;
  if (key.requestsPerSecond > 0) share.tokens -= 1;
  return {std::move(place), 0};
}

KeyUsage::Share& KeyUsage::refilled(const AccessKey& key, Clock::time_point now) {
  std::shared_ptr<Share>& held = shares_[key.name];
  if (!held) held = std::make_shared<Share>();
  const std::chrono::duration<double> since = now - held->filled;
  const double gained = held->isNew ? key.burst : key.requestsPerSecond * std::max(since.count(), 0.0);
  held->tokens = std::min(held->tokens + gained, key.burst);
  held->filled = now;
  held->isNew = false;
  return *held;
}

int KeyUsage::waitOf(const AccessKey& key, const Share& share) {
  constexpr double kAlmostWhole = 1 - 1e-9; // what comes in pieces adds up to a little less than one
  if (key.requestsPerSecond > 0 && share.tokens < kAlmostWhole) {
    return std::max(1, static_cast<int>(std::ceil((1 - share.tokens) / key.requestsPerSecond)));
  }
  return key.concurrent > 0 && share.running >= key.concurrent ? 1 : 0;
}

} // namespace gnomon
