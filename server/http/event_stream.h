#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>

#include "server/http/reply.h"

namespace gnomon {

/// One server-sent event (WHATWG HTML, "Server-sent events"). `data`: one line.
std::string eventText(std::string_view name, std::string_view data);

/// Events between the threads that make them and the one that sends them.
class EventStream {
 public:
  void put(std::string_view name, std::string_view data); ///< any thread
  void end();                                             ///< any thread; nothing is put after it

  /// Sends what is put until the end, and a comment after every `pause` without an event, so that proxies keep the
  /// connection open and a lost client is noticed. False: the client is gone.
  bool sendTo(const BodySink& sink, std::chrono::milliseconds pause);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string waiting_; ///< events as text
  bool ended_ = false;
};

} // namespace gnomon
