#include "server/redis/subscription.h"

#include <algorithm>
#include <exception>
#include <poll.h>

#include "server/redis/stream.h"
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
  int failures = 0; // in a row
  while (!stop_.raised()) {
    ++failures;
    try {
      auto connection = redis_.connect({Clock::now() + kPatience, {}, &stop_});
      if (connection && listen(**connection)) failures = 1;
    } catch (const std::exception& error) {
      logEvent("redis", error.what()); // out of memory: again, later
    }
    waitFor(stop_.fd(), POLLIN, std::max(redis_.nextAttempt(), Clock::now() + backoffDelay(failures, 0)), nullptr);
  }
}

/// Until the connection ends, or does not answer. False where it was not subscribed.
bool Subscription::listen(Connection& connection) {
  const auto call = [this](std::chrono::seconds patience) { return Call{Clock::now() + patience, {}, &stop_}; };
  if (!connection.send({"SUBSCRIBE", channel_}, call(kPatience))) return false;
  bool isSubscribed = false;
  bool isAsked = true;
  while (!stop_.raised()) {
    auto received = connection.receive(call(isAsked ? kPatience : kQuiet));
    if (!received || (!*received && isAsked)) return isSubscribed;
    if (!*received) {
      if (!connection.send({"PING"}, call(kPatience))) return isSubscribed;
      isAsked = true;
      continue;
    }
    isAsked = false;
    const std::vector<Reply>& parts = (*received)->elements;
    if ((*received)->isError()) logEvent("redis", "A subscription is refused: " + (*received)->text);
    if (parts.empty()) return isSubscribed;
    if (parts[0].text == "subscribe") {
      isSubscribed = true;
      callSafely(listener_.begun);
    }
    if (parts[0].text == "message" && parts.size() == 3) callSafely(listener_.message, parts[2].text);
  }
  return isSubscribed;
}

} // namespace gnomon::redis
