#include "server/handlers/frame_handlers.h"

#include "protocol/base/elapsed.h"
#include "server/frames/etag.h"
#include "server/frames/frame_cost.h"
#include "server/frames/frame_reply.h"
#include "server/handlers/settle_quality.h"
#include "server/http/ascii.h"
#include "server/http/problem_reply.h"
#include "server/scenes/bundle_format.h"
#include "server/scenes/upload.h"

namespace gnomon {
namespace {

/// A frame that is asked for, whichever way it came.
struct FrameCall {
  std::string sceneId;
  FrameSpec spec;
  std::function<Result<LoadedScene>()> load; ///< called only when the frame must be drawn
  std::string cacheControl;
};

/// Stages in the order of a request, the renderer's own between ours.
void addStages(FrameReport& report, double queueMs, double loadMs) {
  report.stages.insert(report.stages.begin(), {StageTime{"queue", queueMs}, StageTime{"load", loadMs}});
}

HttpReply draw(Services& services, const RouteCall& call, const FrameCall& frame, FrameForm form,
               const std::string& etag) {
  const std::string& requestId = call.request.id;
  const auto start = Clock::now();
  const std::size_t bytes = frameBytes(frame.spec);
  if (bytes > services.frameMemoryBytes) {
    return problemReply({{ProblemCode::tooLarge, "/views", "The views of this frame are too large together.",
                          std::to_string(services.frameMemoryBytes) + " bytes", std::to_string(bytes) + " bytes"}},
                        requestId);
  }
  ByteLease lease(services.frameBytes);
  if (!lease.grow(bytes)) {
    return busyReply({{ProblemCode::busy, "", "Frames that are under way fill the memory set aside for them.", "", ""}},
                     requestId, 1);
  }
  auto loaded = frame.load();
  if (!loaded) {
    return problemReply(loaded.problems(), requestId);
  }
  const double loadMs = millisecondsSince(start);
  FrameSpec spec = frame.spec;
  std::optional<QualityReport> quality;
  if (spec.quality) {
    auto settled = settleQuality(services, call, frame.sceneId, *loaded, spec);
    if (!settled) {
      return settled.problems().front().code == ProblemCode::busy ? busyReply(settled.problems(), requestId, 10)
                                                                  : problemReply(settled.problems(), requestId);
    }
    quality = *std::move(settled);
    spec = withTrial(spec, quality->tried[quality->chosen]);
  }
  auto drawn = services.queue.render({loaded->scene, spec, Clock::now() + services.requestTimeout, call.clientGone});
  if (const auto* full = std::get_if<QueueFull>(&drawn)) {
    return busyReply(
        {{ProblemCode::busy, "", "The render queue is full.", std::to_string(full->limit) + " frames", ""}}, requestId,
        full->retryAfterSeconds);
  }
  if (const auto* problems = std::get_if<Problems>(&drawn)) {
    return problemReply(*problems, requestId);
  }
  auto& queued = std::get<QueuedFrame>(drawn);
  addStages(queued.frame.report, queued.queueMs, loadMs);
  queued.frame.report.quality = std::move(quality);
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
        {{ProblemCode::notAcceptable, "", "A frame can't be sent in any form that Accept names.",
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
    reply.bodyOmitted = true; // not drawn for nobody to see
  } else {
    reply = draw(services, call, frame, *form, etag);
    if (reply.status != 200) {
      return reply;
    }
  }
  // What meets a target depends on how fast the machine was.
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
    return problemReply({{ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)}},
                        call.request.id);
  }
  if (!spec) {
    return problemReply(spec.problems(), call.request.id);
  }
  return answer(services, call,
                {id, *std::move(spec), [&services, id] { return services.store.get(id); }, std::move(cacheControl)});
}

constexpr const char* kShared = "public, max-age=86400"; ///< the address tells everything; the tag tells upgrades
constexpr const char* kPrivate = "private, no-cache";

} // namespace

HttpReply postFrame(Services& services, RouteCall call) {
  const std::string_view body = textOf(call.request.body);
  auto spec = decodeFrameSpec(body.empty() ? "{}" : body);
  return answerStored(services, call, std::move(spec), kPrivate);
}

HttpReply getFrame(Services& services, RouteCall call) {
  auto spec = decodeFrameQuery(call.request.query);
  return answerStored(services, call, std::move(spec), kShared);
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
          {{ProblemCode::tooLarge, "spec", "The part is larger than a specification may be.",
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
