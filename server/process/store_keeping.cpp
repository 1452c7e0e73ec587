#include "server/process/store_keeping.h"

#include <algorithm>
#include <exception>
#include <poll.h>

#include "server/system/log.h"

namespace gnomon {
namespace {

/// A scene is removed when it is older than its age by less than a quarter, or than the longest period.
std::chrono::milliseconds lengthOf(const KeepingPeriod& period) {
  constexpr std::chrono::milliseconds kShortest{500};
  if (period.age.count() == 0) return period.longest;
  return std::clamp(std::chrono::milliseconds(period.age) / 4, kShortest, period.longest);
}

void keepClean(SceneStore& store, Dispatcher& workers) {
  try {
    store.keepClean([&](const std::string& id) { workers.forget(id); });
  } catch (const std::exception& error) {
    logEvent("store", error.what()); // out of memory: next time
  }
}

} // namespace

StoreKeeping::StoreKeeping(SceneStore& store, Dispatcher& workers, const KeepingPeriod& period)
    : store_(store), thread_([this, &store, &workers, length = lengthOf(period)] {
        const auto stopped = [&] {
          pollfd waiting{stop_.fd(), POLLIN, 0};
          return ::poll(&waiting, 1, static_cast<int>(length.count())) > 0;
        };
        do {
          keepClean(store, workers);
        } while (!stopped());
      }) {
  store.onRemoved([&workers](const std::string& id) { workers.forget(id); });
}

StoreKeeping::~StoreKeeping() {
  store_.onRemoved(nullptr);
  stop_.raise();
  thread_.join();
}

} // namespace gnomon
