#include <nlohmann/json.hpp>
#include <variant>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/frames/reply_cache.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"
#include "server/http/url.h"
#include "server/scenes/upload.h"

namespace gnomon {
namespace {

/// A request for a frame, of whichever route.
struct FrameCall {
  std::string sceneId;
  FrameSpec spec;
  std::function<Result<StoredBundle>()> bundle; ///< called only when a worker must see the scene
  std::string cacheControl;
  SceneCounts counts;    ///< as far as they are known
  std::string request{}; ///< names all that the reply depends on; empty = the body counts too
};

/// The task of drawing it, or the reply that refuses it.
std::variant<Task, HttpReply> taskOf(Services& services, const RouteCall& call, const FrameCall& frame) {
  auto bundle = frame.bundle();
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  auto made = frameTask(services, call, frame.sceneId, *std::move(bundle), frame.spec, frame.counts);
  if (made) return *std::move(made);
  return problemReply(made.problems(), call.request.id, {.refusal = RefusalReason::cost});
}

HttpReply draw(Services& services, const RouteCall& call, const FrameCall& frame, FrameForm form,
               const std::string& etag) {
  auto made = taskOf(services, call, frame);
  if (auto* refused = std::get_if<HttpReply>(&made)) return std::move(*refused);
  Task task = std::get<Task>(std::move(made));
  task.order.mediaType = mediaTypeOf(form);
  task.order.boundary = "gnomon-" + etag.substr(etag.find('"') + 1, 32);
  const auto drawn = [&](const std::function<bool()>& gone) {
    HttpReply reply = replyOf(runTask(services, task, gone), call.request.id);
    if (reply.status == 200) reply.headers.emplace_back("Repr-Digest", reprDigest(reply.body));
    return reply;
  };
  if (frame.spec.quality || tellsTimes(form)) return drawn(call.clientGone);
  return services.shared.run(etag, task.deadline, call.clientGone, [&](const std::function<bool()>& gone) {
    if (const auto kept = services.replies.findAgain(etag)) return *kept; // drawn since we looked
    HttpReply reply = drawn(gone);
    services.replies.keep(etag, reply);
    return reply;
  });
}

/// What drawing would refuse, found by planning alone: no picture is sent. Where settings are to be chosen,
/// the plan is of those that were asked for beside.
HttpReply check(Services& services, const RouteCall& call, const FrameCall& frame, FrameForm form) {
  auto made = taskOf(services, call, frame);
  if (auto* refused = std::get_if<HttpReply>(&made)) return std::move(*refused);
  Task task = std::get<Task>(std::move(made));
  FrameSpec spec = frame.spec;
  spec.quality.reset();
  task.request = jsonText(toJson(spec));
  task.order.kind = OrderKind::plan;
  task.lane = Lane::interactive;
  task.holdsRenderer = false;
  HttpReply reply = replyOf(runTask(services, std::move(task), call.clientGone), call.request.id);
  if (reply.status != 200) return reply;
  HttpReply checked;
  checked.contentType = mediaTypeOf(form);
  checked.bodyOmitted = true;
  return checked;
}

/// A reply that caches may keep as these say.
HttpReply labelled(HttpReply reply, const std::string& etag, const std::string& cacheControl) {
  if (!etag.empty()) reply.headers.emplace_back("ETag", etag);
  reply.headers.emplace_back("Cache-Control", cacheControl);
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

HttpReply answer(Services& services, const RouteCall& call, FrameCall frame) {
  const HttpRequest& request = call.request;
  const auto accept = headerValue(request.headers, "accept");
  const auto form = negotiate(accept, frame.spec.output.format);
  if (!form) return problemReply({notAcceptable("A frame", accept, kFrameTypes)}, request.id);
  frame.spec.output.format = form->format;
  const std::string etag = frameEtag(frame.sceneId, frame.spec, services.workers.info().fingerprint, *form);

  HttpReply reply;
  const bool mayBeKept = request.method != "HEAD" && !tellsTimes(*form) && !frame.spec.quality;
  const std::string tag = frame.spec.quality ? "" : etag;
  const Precondition condition = preconditionOf(request.headers, tag);
  const auto kept = mayBeKept && condition != Precondition::known ? services.replies.find(etag) : nullptr;
  if (kept) {
    reply = *kept;
  } else if (condition != Precondition::known) { // a client that names the tag has the picture
    const bool isSent = condition == Precondition::holds && request.method != "HEAD";
    reply = isSent ? draw(services, call, frame, *form, etag) : check(services, call, frame, *form);
    if (reply.status != 200) return reply;
  }
  if (condition == Precondition::failed) return problemReply({preconditionFailed(request.headers, tag)}, request.id);
  if (condition != Precondition::holds) {
    reply = HttpReply();
    reply.status = 304;
  }
  if (mayBeKept && !frame.request.empty()) services.replies.remember(frame.request, etag);
  // Which settings meet a target depends on how fast the machine was.
  return frame.spec.quality ? labelled(std::move(reply), "", "no-store")
                            : labelled(std::move(reply), etag, frame.cacheControl);
}

/// The frame of a stored scene.
HttpReply answerStored(Services& services, const RouteCall& call, Result<FrameSpec> spec, std::string cacheControl,
                       std::string request = {}) {
  const std::string& id = call.values.at("id");
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), call.request.id);
  if (!spec) return problemReply(spec.problems(), call.request.id);
  return answer(services, call,
                {id, *std::move(spec), [&services, id] { return services.store.bundle(id); }, std::move(cacheControl),
                 services.store.counts(id).value_or(SceneCounts()), std::move(request)});
}

/// Everything that the picture depends on is in the URL, but the renderer, and that is in the entity tag.
constexpr const char* kShared = "public, max-age=86400";
constexpr const char* kPrivate = "private, no-cache";

} // namespace

HttpReply postFrame(Services& services, RouteCall call) {
  auto spec = decodeFrameSpec(asText(call.request.body));
  return answerStored(services, call, std::move(spec), kPrivate);
}

HttpReply getFrame(Services& services, RouteCall call) {
  const HttpRequest& request = call.request;
  std::string name;
  if (request.method == "GET") {
    const auto accept = headerValue(request.headers, "accept");
    name = request.target + '\n' + std::string(accept.value_or("")) + '\n' + services.workers.info().fingerprint;
    const bool isPlain = !headerValue(request.headers, "if-none-match") && !headerValue(request.headers, "if-match") &&
                         static_cast<bool>(services.store.use(call.values.at("id")));
    if (auto kept = isPlain ? services.replies.findRequest(name) : std::nullopt) {
      return labelled(*kept->reply, kept->etag, kShared);
    }
  }
  auto spec = decodeFrameQuery(request.query);
  return answerStored(services, call, std::move(spec), kShared, std::move(name));
}

HttpReply postPlan(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), call.request.id);
  const auto spec = decodeFrameSpec(asText(call.request.body));
  if (!spec) return problemReply(spec.problems(), call.request.id);
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  Task task = taskFor(call, OrderKind::plan, id, *std::move(bundle), jsonText(toJson(*spec)), services.requestTimeout);
  return replyOf(runTask(services, std::move(task), call.clientGone), call.request.id);
}

HttpReply renderOnce(Services& services, RouteCall call) {
  const std::string id = call.request.id;
  const auto parts = partsOf(call.request, services.limits);
  if (!parts) return problemReply(parts.problems(), id);
  Result<FrameSpec> spec = FrameSpec{};
  bool hasSpec = false;
  for (const FormPart& part : *parts) {
    if (part.name != "spec") continue;
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
  if (!spec) return problemReply(spec.problems(), id);
  const auto strict = queryFlag(call.request.query, "strict");
  if (!strict) return problemReply(strict.problems(), id);
  auto bundle = bundleFromParts(*parts, {"spec"});
  if (!bundle) return problemReply(bundle.problems(), id);
  if (auto fits = checkBundleSize(*bundle, services.limits); !fits) return problemReply(fits.problems(), id);
  call.request.body = Bytes();
  const auto pack = packed(*bundle);
  if (!pack) return problemReply(pack.problems(), id);
  if (*strict || bundle->strict) {
    HttpReply loaded = loadScene(services, call, pack->id, {pack->file}, true);
    if (loaded.status != 200) return loaded;
  }
  bundle = SceneBundle();
  const auto give = [&pack]() -> Result<StoredBundle> { return StoredBundle{pack->file}; };
  return answer(services, call, {pack->id, *std::move(spec), give, kPrivate, {}});
}

} // namespace gnomon
