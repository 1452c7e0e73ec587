#include "server/redis/subscription.h"

#include <algorithm>
#include <exception>
#include <poll.h>

#include "server/redis/dial.h"
#include "server/system/log.h"

namespace gnomon::redis {
namespace {

constexpr std::chrono::seconds kQuiet{1};    ///< after it the server is asked whether it is there
constexpr std::chrono::seconds kPatience{2}; ///< for what it answers then, and to subscribe

template <class Function, class... Arguments>
void callSafely(const Function& function, const Arguments&... arguments) {
  try {
    if (function) function(arguments...);
  } catch (const std::exception& error) {
    logEvent("redis", error.what());
  }
}

} // namespace

Subscription::Subscription(Redis& redis, std::string channel, Listener listener)
    : redis_(redis), channel_(std::move(channel)), listener_(std::move(listener)), thread_([this] { run(); }) {}

Subscription::~Subscription() {
  stop_.raise();
  thread_.join();
}

void Subscription::run() {
  constexpr std::chrono::milliseconds kLeast{20};
  while (!stop_.raised()) {
    try {
      auto connection = redis_.connect({Clock::now() + kPatience, {}, &stop_});
      if (connection) listen(**connection);
    } catch (const std::exception& error) {
      logEvent("redis", error.what()); // out of memory: again, later
    }
    waitFor(stop_.fd(), POLLIN, std::max(redis_.nextAttempt(), Clock::now() + kLeast), nullptr);
  }
}

/// Until the connection ends, or does not answer.
void Subscription::listen(Connection& connection) {
  const auto call = [this](std::chrono::seconds patience) { return Call{Clock::now() + patience, {}, &stop_}; };
  if (!connection.tell({"SUBSCRIBE", channel_}, call(kPatience))) return;
  bool isAsked = true;
  while (!stop_.raised()) {
    auto heard = connection.hear(call(isAsked ? kPatience : kQuiet));
    if (!heard || (!*heard && isAsked)) return;
    if (!*heard) {
      if (!connection.tell({"PING"}, call(kPatience))) return;
      isAsked = true;
      continue;
    }
    isAsked = false;
    const std::vector<Reply>& parts = (*heard)->elements;
    if (parts.empty()) return; // an error
    if (parts[0].text == "subscribe") callSafely(listener_.begun);
    if (parts[0].text == "message" && parts.size() == 3) callSafely(listener_.told, parts[2].text);
  }
}

} // namespace gnomon::redis
