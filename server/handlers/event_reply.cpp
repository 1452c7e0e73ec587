#include "server/handlers/event_reply.h"

#include <atomic>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "protocol/json/json_codec.h"
#include "server/system/no_thread.h"
#include "server/wire/messages.h"

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

std::string problemText(const Problems& reasons, const std::string& requestId) {
  const Problems problems = atLeastOne(reasons);
  return jsonText(problemJson(problems, statusOf(problems.front().code), requestId));
}

HttpReply eventStream() {
  HttpReply reply;
  reply.contentType = kEventStream;
  reply.headers.emplace_back("X-Accel-Buffering", "no"); // asks proxies to pass events on at once
  return reply;
}

HttpReply eventReply(const RouteCall& call, EventWork work) {
  HttpReply reply = eventStream();
  const auto result = std::make_shared<StreamResult>();
  reply.streamed = result;
  reply.stream = [work = std::move(work), result, requestId = call.request.id,
                  clientGone = call.clientGone](const BodySink& sink) -> std::shared_ptr<ReplyWait> {
    constexpr std::chrono::milliseconds kHeartbeat{5'000};
    EventStream events;
    std::atomic<bool> clientLeft = false;
    const auto fail = [&](const Problem& problem) {
      result->problem = problem.detail;
      events.put("problem", problemText({problem}, requestId));
      events.end();
    };
    std::thread working;
    try {
      working = std::thread([&] {
        try {
          *result = work([&] { return clientLeft || clientGone(); }, events);
          events.end();
        } catch (const std::exception&) {
          fail({ProblemCode::internal, "", "An internal error occurred.", "", ""});
        }
      });
    } catch (const std::system_error&) {
      fail(noThreadFor("the work"));
    }
    clientLeft = !events.sendTo(sink, kHeartbeat);
    if (working.joinable()) working.join();
    return nullptr;
  };
  return reply;
}

} // namespace gnomon
