#include "server/handlers/event_reply.h"

#include <atomic>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/system/no_thread.h"
#include "server/wire/messages.h"

namespace gnomon {

std::string problemText(const Problems& problems, const std::string& requestId) {
  return jsonText(problemJson(problems, statusOf(problems.front().code), requestId));
}

HttpReply eventReply(const RouteCall& call, EventWork work) {
  HttpReply reply;
  reply.contentType = kEventStream;
  reply.headers.emplace_back("X-Accel-Buffering", "no"); // asks proxies to pass events on at once
  const auto result = std::make_shared<StreamResult>();
  reply.streamed = result;
  reply.stream = [work = std::move(work), result, requestId = call.request.id,
                  clientGone = call.clientGone](const BodySink& sink) {
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
  };
  return reply;
}

} // namespace gnomon
