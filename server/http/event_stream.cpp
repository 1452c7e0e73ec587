#include "server/http/event_stream.h"

#include <utility>

namespace gnomon {

std::string eventText(std::string_view name, std::string_view data) {
  std::string text = "event: ";
  return text.append(name).append("\ndata: ").append(data).append("\n\n");
}

void EventStream::put(std::string_view name, std::string_view data) {
  constexpr std::string_view kProgress = "progress";
  {
    const std::lock_guard lock(mutex_);
    if (isGivenUp_ || bytes_ > kMostBytes) {
      isGivenUp_ = true;
      return;
    }
    const bool replaces = waiting_.size() >= kMostEvents && name == kProgress && waiting_.back().name == kProgress;
    if (replaces) {
      bytes_ -= waiting_.back().text.size();
      waiting_.pop_back();
    }
    waiting_.push_back({std::string(name), eventText(name, data)});
    bytes_ += waiting_.back().text.size();
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
    std::string text;
    bool last = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, pause, [this] { return ended_ || !waiting_.empty(); });
      if (isGivenUp_) return false;
      for (const Event& event : std::exchange(waiting_, {})) text += event.text;
      bytes_ = 0;
      last = ended_;
    }
    if (text.empty() && !last) text = ":\n\n";
    if (!text.empty() && !sink(text)) return false;
    if (last) return true;
  }
}

} // namespace gnomon
