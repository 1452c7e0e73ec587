#include "server/handlers/plan_handlers.h"

#include "server/http/ascii.h"
#include "server/http/json_reply.h"
#include "server/http/problem_reply.h"

namespace gnomon {
namespace {

/// One of the few plans that are made at once, while it lives.
class Turn {
 public:
  Turn(Services& services, Clock::time_point deadline)
      : services_(services), held_(services.plans.try_acquire_until(deadline)) {}
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    if (held_) services_.plans.release();
  }

  bool held() const { return held_; }

 private:
  Services& services_;
  bool held_;
};

} // namespace

HttpReply postPlan(Services& services, RouteCall call) {
  const auto deadline = Clock::now() + services.requestTimeout;
  const std::string& id = call.values.at("id");
  const std::string& requestId = call.request.id;
  if (!services.store.contains(id)) {
    return problemReply({{ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)}},
                        requestId);
  }
  const std::string_view body = textOf(call.request.body);
  const auto spec = decodeFrameSpec(body.empty() ? "{}" : body);
  if (!spec) {
    return problemReply(spec.problems(), requestId);
  }
  const auto loaded = services.store.get(id);
  if (!loaded) {
    return problemReply(loaded.problems(), requestId);
  }
  const Turn turn(services, deadline);
  if (!turn.held()) {
    return problemReply({{ProblemCode::deadlineExceeded, "", "Other plans took longer than a request may.", "", ""}},
                        requestId);
  }
  const auto plan = planFrame(*loaded->scene, *spec, services.queue.info());
  return plan ? jsonReply(toJson(*plan)) : problemReply(plan.problems(), requestId);
}

} // namespace gnomon
