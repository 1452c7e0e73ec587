#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "server/http/reply.h"
#include "server/http/router.h"

namespace gnomon {

/// One server-sent event (WHATWG HTML, "Server-sent events"). `data`: one line.
std::string eventText(std::string_view name, std::string_view data);

/// Events between the threads that make them and the one that sends them. Those that wait for a slow client are
/// bounded: the newest `progress` takes the place of the one before it once kMostEvents wait, and a client that has
/// left kMostBytes unread when more comes is given up.
class EventStream {
 public:
  static constexpr std::size_t kMostEvents = 64;
  static constexpr std::size_t kMostBytes = 16 << 20;

  void put(std::string_view name, std::string_view data); ///< any thread
  void end();                                             ///< any thread; nothing is put after it

  /// Sends what is put until the end, and a comment after every `pause` without an event, so that proxies keep the
  /// connection open and a lost client is noticed. False: the client is gone, or was given up.
  bool sendTo(const BodySink& sink, std::chrono::milliseconds pause);

 private:
  struct Event {
    std::string name;
    std::string text;
  };

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Event> waiting_;
  std::size_t bytes_ = 0; ///< of what waits
  bool isGivenUp_ = false;
  bool ended_ = false;
};

/// Work that puts its progress and its result as events, and returns what became of it. `gone` may be called by any
/// thread; true = the client is gone, and the work should end soon.
using EventWork = std::function<StreamResult(const std::function<bool()>& gone, EventStream& events)>;

/// A reply of events, without them.
HttpReply eventStream();

/// A reply of events that are sent while `work` runs, on a thread of its own. An exception becomes an event `problem`.
HttpReply eventReply(const RouteCall& call, EventWork work);

/// The data of an event `problem`.
std::string problemText(const Problems& problems, const std::string& requestId);

} // namespace gnomon
