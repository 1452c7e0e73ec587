#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/query_codec.h"
#include "server/frames/frame_reply.h"
#include "server/handlers/handlers.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"
#include "server/scenes/bundle.h"

namespace gnomon {
namespace {

/// A request for a frame, of whichever route.
struct FrameCall {
  std::string sceneId;
  FrameSpec spec;
  std::function<Result<LoadedScene>()> load; ///< called only when the frame must be drawn
  std::string cacheControl;
};

/// Puts the server's stages before the renderer's.
void addStages(FrameReport& report, double queueMs, double loadMs) {
  report.stages.insert(report.stages.begin(), {StageTime{"queue", queueMs}, StageTime{"load", loadMs}});
}

/// Gives `spec` the settings that meet its target, and returns how they were chosen; nothing where it has no target.
Result<std::optional<QualityReport>> meetTarget(Services& services, const RouteCall& call, const LoadedScene& scene,
                                                FrameSpec& spec) {
  if (!spec.quality) {
    return std::optional<QualityReport>();
  }
  auto report = settleQuality(services.evaluations, services.choices, scene, spec, call.clientGone);
  if (!report) {
    return std::move(report).problems();
  }
  spec = withChoice(spec, *report);
  return std::optional(*std::move(report));
}

HttpReply draw(Services& services, const RouteCall& call, const FrameCall& frame, FrameForm form,
               const std::string& etag) {
  const std::string& requestId = call.request.id;
  const auto start = Clock::now();
  const std::size_t bytes = frameBytes(frame.spec);
  if (bytes > services.frameMemory.total()) {
    return problemReply({{ProblemCode::tooLarge, "/views", "The views of this frame together are too large.",
                          std::to_string(services.frameMemory.total()) + " bytes", std::to_string(bytes) + " bytes"}},
                        requestId);
  }
  ByteLease lease(services.frameMemory);
  if (!lease.grow(bytes)) {
    return problemReply({{ProblemCode::busy, "", "Other frames in progress use all the memory for frames.", "", ""}},
                        requestId);
  }
  auto loaded = frame.load();
  if (!loaded) {
    return problemReply(loaded.problems(), requestId);
  }
  const double loadMs = millisecondsSince(start);
  FrameSpec spec = frame.spec;
  auto quality = meetTarget(services, call, *loaded, spec);
  if (!quality) {
    return problemReply(quality.problems(), requestId, {.retryAfterSeconds = kEvaluationRetrySeconds});
  }
  auto drawn = services.queue.render({loaded->scene, spec, Clock::now() + services.requestTimeout, call.clientGone});
  if (const auto* full = std::get_if<QueueFull>(&drawn)) {
    return problemReply({full->problem()}, requestId, {.retryAfterSeconds = full->retryAfterSeconds});
  }
  if (const auto* problems = std::get_if<Problems>(&drawn)) {
    return problemReply(*problems, requestId);
  }
  auto& queued = std::get<QueuedFrame>(drawn);
  addStages(queued.frame.report, queued.queueMs, loadMs);
  queued.frame.report.quality = *std::move(quality);
  const std::string boundary = "gnomon-" + etag.substr(etag.find('"') + 1, 32);
  auto reply = frameReply(std::move(queued.frame), form, boundary);
  return reply ? *std::move(reply) : problemReply(reply.problems(), requestId);
}

HttpReply answer(Services& services, const RouteCall& call, FrameCall frame) {
  const HttpRequest& request = call.request;
  const auto accept = headerValue(request.headers, "accept");
  const auto form = negotiate(accept, frame.spec.output.format);
  if (!form) {
    return problemReply(
        {{ProblemCode::notAcceptable, "", "A frame can't be sent as any media type that Accept lists.",
          "image/png, image/x-exr, multipart/mixed, application/json", asciiExcerpt(accept.value_or(""))}},
        request.id);
  }
  frame.spec.output.format = form->format;
  const std::string etag = frameEtag(frame.sceneId, frame.spec, services.queue.info().fingerprint, *form);

  HttpReply reply;
  const auto known = headerValue(request.headers, "if-none-match");
  if (known && !frame.spec.quality && etagMatches(*known, etag)) {
    reply.status = 304;
  } else if (request.method == "HEAD") {
    reply.contentType = mediaTypeOf(*form);
    reply.bodyOmitted = true; // nobody would see the picture
  } else {
    reply = draw(services, call, frame, *form, etag);
    if (reply.status != 200) {
      return reply;
    }
  }
  // Which settings meet a target depends on how fast the machine was.
  if (frame.spec.quality) {
    reply.headers.emplace_back("Cache-Control", "no-store");
  } else {
    reply.headers.emplace_back("ETag", etag);
    reply.headers.emplace_back("Cache-Control", frame.cacheControl);
  }
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

/// The frame of a stored scene.
HttpReply answerStored(Services& services, const RouteCall& call, Result<FrameSpec> spec, std::string cacheControl) {
  const std::string& id = call.values.at("id");
  if (!services.store.contains(id)) {
    return problemReply({unknownScene(id)}, call.request.id);
  }
  if (!spec) {
    return problemReply(spec.problems(), call.request.id);
  }
  return answer(services, call,
                {id, *std::move(spec), [&services, id] { return services.store.get(id); }, std::move(cacheControl)});
}

/// Everything that the picture depends on is in the URL, but the renderer, and that is in the entity tag.
constexpr const char* kShared = "public, max-age=86400";
constexpr const char* kPrivate = "private, no-cache";

/// A permit to make a plan, of which there are only a few at a time; returned at its end.
class PlanPermit {
 public:
  PlanPermit(Services& services, Clock::time_point deadline)
      : services_(services), held_(services.plans.try_acquire_until(deadline)) {}
  PlanPermit(const PlanPermit&) = delete;
  PlanPermit& operator=(const PlanPermit&) = delete;
  ~PlanPermit() {
    if (held_) {
      services_.plans.release();
    }
  }

  bool held() const { return held_; }

 private:
  Services& services_;
  bool held_;
};

} // namespace

HttpReply postFrame(Services& services, RouteCall call) {
  const std::string_view body = asText(call.request.body);
  auto spec = decodeFrameSpec(body.empty() ? "{}" : body);
  return answerStored(services, call, std::move(spec), kPrivate);
}

HttpReply getFrame(Services& services, RouteCall call) {
  auto spec = decodeFrameQuery(call.request.query);
  return answerStored(services, call, std::move(spec), kShared);
}

HttpReply postPlan(Services& services, RouteCall call) {
  const auto deadline = Clock::now() + services.requestTimeout;
  const std::string& id = call.values.at("id");
  const std::string& requestId = call.request.id;
  if (!services.store.contains(id)) {
    return problemReply({unknownScene(id)}, requestId);
  }
  const std::string_view body = asText(call.request.body);
  const auto spec = decodeFrameSpec(body.empty() ? "{}" : body);
  if (!spec) {
    return problemReply(spec.problems(), requestId);
  }
  const auto loaded = services.store.get(id);
  if (!loaded) {
    return problemReply(loaded.problems(), requestId);
  }
  const PlanPermit permit(services, deadline);
  if (!permit.held()) {
    return problemReply(
        {{ProblemCode::deadlineExceeded, "", "Other plans took the time until the request's deadline.", "", ""}},
        requestId);
  }
  const auto plan = planFrame(*loaded->scene, *spec, services.queue.info());
  return plan ? jsonReply(toJson(*plan)) : problemReply(plan.problems(), requestId);
}

HttpReply renderOnce(Services& services, RouteCall call) {
  const std::string id = call.request.id;
  const auto parts = partsOf(call.request, services.limits);
  if (!parts) {
    return problemReply(parts.problems(), id);
  }
  Result<FrameSpec> spec = FrameSpec{};
  bool hasSpec = false;
  for (const FormPart& part : *parts) {
    if (part.name != "spec") {
      continue;
    }
    if (hasSpec) {
      return problemReply({{ProblemCode::invalidValue, "spec", "The form has two parts of this name.", "", ""}}, id);
    }
    if (part.content.size() > services.limits.maxSpecBytes) {
      return problemReply(
          {{ProblemCode::tooLarge, "spec", "The part is larger than a frame specification may be.",
            std::to_string(services.limits.maxSpecBytes) + " bytes", std::to_string(part.content.size()) + " bytes"}},
          id);
    }
    spec = decodeFrameSpec(part.content);
    hasSpec = true;
  }
  if (!spec) {
    return problemReply(spec.problems(), id);
  }
  auto bundle = bundleFromParts(*parts, {"spec"});
  if (!bundle) {
    return problemReply(bundle.problems(), id);
  }
  if (auto fits = checkBundleSize(*bundle, services.limits); !fits) {
    return problemReply(fits.problems(), id);
  }
  call.request.body = Bytes();
  const std::string sceneId = bundleId(*bundle);
  const auto load = [&services, &sceneId, &bundle] { return services.store.use(sceneId, *bundle); };
  return answer(services, call, {sceneId, *std::move(spec), load, kPrivate});
}

} // namespace gnomon
