#include "server/http/event_stream.h"

#include <utility>

namespace gnomon {

std::string eventText(std::string_view name, std::string_view data) {
  std::string text = "event: ";
  return text.append(name).append("\ndata: ").append(data).append("\n\n");
}

void EventStream::put(std::string_view name, std::string_view data) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ += eventText(name, data);
  }
  changed_.notify_one();
}

void EventStream::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
}

bool EventStream::sendTo(const BodySink& sink, std::chrono::milliseconds pause) {
  while (true) {
    std::string events;
    bool last = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, pause, [this] { return ended_ || !waiting_.empty(); });
      events = std::exchange(waiting_, {});
      last = ended_;
    }
    if (events.empty() && !last) {
      events = ":\n\n";
    }
    if (!events.empty() && !sink(events)) {
      return false;
    }
    if (last) {
      return true;
    }
  }
}

} // namespace gnomon
