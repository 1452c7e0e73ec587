#include "server/process/store_keeping.h"

#include <algorithm>
#include <exception>
#include <poll.h>

#include "server/system/log.h"

namespace gnomon {
namespace {

/// A scene is removed when it is older than its age by less than a quarter, or than a minute.
std::chrono::milliseconds periodOf(std::chrono::seconds age) {
  constexpr std::chrono::milliseconds kLongest = std::chrono::minutes(1);
  constexpr std::chrono::milliseconds kShortest{500};
  return age.count() > 0 ? std::clamp(std::chrono::milliseconds(age) / 4, kShortest, kLongest) : kLongest;
}

void keepClean(SceneStore& store, Dispatcher& workers) {
  try {
    store.keepClean([&](const std::string& id) { workers.forget(id); });
  } catch (const std::exception& error) {
    logEvent("store", error.what()); // out of memory: next time
  }
}

} // namespace

StoreKeeping::StoreKeeping(SceneStore& store, Dispatcher& workers, std::chrono::seconds age)
    : thread_([this, &store, &workers, period = periodOf(age)] {
        const auto stopped = [&] {
          pollfd waiting{stop_.fd(), POLLIN, 0};
          return ::poll(&waiting, 1, static_cast<int>(period.count())) > 0;
        };
        do {
          keepClean(store, workers);
        } while (!stopped());
      }) {}

StoreKeeping::~StoreKeeping() {
  stop_.raise();
  thread_.join();
}

} // namespace gnomon
