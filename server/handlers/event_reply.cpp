#include "server/handlers/event_reply.h"

#include <atomic>
#include <exception>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/wire/messages.h"

namespace gnomon {

std::string problemText(const Problems& problems, const std::string& requestId) {
  return jsonText(problemJson(problems, statusOf(problems.front().code), requestId));
}

HttpReply eventReply(const RouteCall& call, EventWork work) {
  HttpReply reply;
  reply.contentType = kEventStream;
  reply.headers.emplace_back("X-Accel-Buffering", "no"); // asks proxies to pass events on at once
  reply.stream = [work = std::move(work), requestId = call.request.id,
                  clientGone = call.clientGone](const BodySink& sink) {
    constexpr std::chrono::milliseconds kHeartbeat{5'000};
    EventStream events;
    std::atomic<bool> clientLeft = false;
    std::thread working([&] {
      try {
        work([&] { return clientLeft || clientGone(); }, events);
      } catch (const std::exception&) {
        events.put("problem",
                   problemText({{ProblemCode::internal, "", "An internal error occurred.", "", ""}}, requestId));
      }
      events.end();
    });
    clientLeft = !events.sendTo(sink, kHeartbeat);
    working.join();
  };
  return reply;
}

} // namespace gnomon
