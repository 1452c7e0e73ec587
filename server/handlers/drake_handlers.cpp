#include <array>

#include "protocol/spec/validate.h"
#include "server/frames/reply_cache.h"
#include "server/handlers/drake_form.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"
#include "server/scenes/upload.h"

namespace gnomon {
namespace {

/// The same refusal for a client that shows its text to people: a line for each problem.
HttpReply inPlainText(HttpReply reply, const Problems& problems) {
  reply.contentType = "text/plain; charset=utf-8";
  std::string text;
  for (const Problem& problem : problems) {
    text += problem.pointer.empty() ? problem.detail : problem.pointer + ": " + problem.detail;
    if (!problem.limit.empty()) text += " Allowed: " + problem.limit + '.';
    if (!problem.actual.empty()) text += " Sent: " + problem.actual + '.';
    text += '\n';
  }
  reply.body = std::move(text);
  return reply;
}

HttpReply refused(const Problems& problems, const RouteCall& call) {
  return inPlainText(problemReply(problems, call.request.id), problems);
}

/// Of depth: metres or, in a PNG, millimetres.
constexpr std::array<std::string_view, 2> kDepthTypes{"image/tiff", "image/png"};
constexpr std::array<std::string_view, 1> kColorTypes{"image/png"};

HttpReply draw(Services& services, const RouteCall& call, const PackedBundle& pack, const DrakeForm& form,
               std::string_view mediaType) {
  const FrameSpec spec = drakeFrame(form, services.drakeColors);
  if (const Problems problems = validate(spec); !problems.empty()) return refused(problems, call);
  const SceneCounts counts = services.store.counts(pack.id).value_or(likelyCounts(pack.bytes));
  auto made = frameTask(services, call, pack.id, {pack.file}, spec, counts);
  if (!made) {
    HttpReply reply = refused(made.problems(), call);
    reply.refusal = RefusalReason::cost;
    return reply;
  }
  Task task = *std::move(made);
  task.order.mediaType = mediaType;
  task.affinityKey =
      "drake " + call.request.client.name; // no two of its scenes are the same, and most hold the same meshes
  task.order.depthRange = form.range;
  task.order.labels = form.image == DrakeImage::label;
  TaskResult result = runTask(services, std::move(task), call.clientGone);
  const Problems problems = result.outcome.problems;
  HttpReply reply = replyOf(std::move(result), call.request.id);
  if (!problems.empty()) return inPlainText(std::move(reply), problems);
  reply.headers.emplace_back("Cache-Control", "no-store");
  reply.headers.emplace_back("Vary", "Accept");
  reply.headers.emplace_back("Repr-Digest", reprDigest(reply.body));
  return reply;
}

} // namespace

HttpReply renderDrake(Services& services, RouteCall call) {
  const auto parts = partsOf(call.request, services.limits);
  if (!parts) return refused(parts.problems(), call);
  const auto form = readDrakeForm(*parts);
  if (!form) return refused(form.problems(), call);
  const std::span<const std::string_view> offers =
      form->range ? std::span<const std::string_view>(kDepthTypes) : kColorTypes;
  const auto accept = headerValue(call.request.headers, "accept");
  const auto type = preferred(accept, offers);
  if (!type) return refused({notAcceptable("This image", accept, offers)}, call);
  SceneBundle bundle;
  bundle.model.assign(form->scene.begin(), form->scene.end());
  if (const auto fits = checkBundleSize(bundle, services.limits); !fits) return refused(fits.problems(), call);
  DrakeForm asked = *form;
  asked.scene = {};
  call.request.body = Bytes();
  const auto pack = packed(bundle);
  if (!pack) return refused(pack.problems(), call);
  bundle = SceneBundle();
  return draw(services, call, *pack, asked, offers[*type]);
}

} // namespace gnomon
