#include <nlohmann/json.hpp>

#include "protocol/base/scene_bundle.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/reply.h"
#include "server/scenes/upload.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

HttpReply summaryReply(std::string summary, int status = 200) {
  HttpReply reply;
  reply.status = status;
  reply.contentType = "application/json";
  reply.body = std::move(summary);
  return reply;
}

HttpReply store(Services& services, RouteCall& call, const std::optional<std::string>& expectedId) {
  auto bundle = bundleFromRequest(call.request, services.limits);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  const auto pack = packed(*bundle);
  if (!pack) return problemReply(pack.problems(), call.request.id);
  const bool strict = bundle->strict;
  bundle = SceneBundle();
  if (expectedId && *expectedId != pack->id) {
    return problemReply({{ProblemCode::hashMismatch, "",
                          "The SHA-256 of the uploaded bytes is not the one in the path.", *expectedId, pack->id}},
                        call.request.id);
  }
  bool isNew = false;
  const auto used = services.store.use(pack->id);
  if (!used && used.problems().front().code != ProblemCode::notFound) {
    return problemReply(used.problems(), call.request.id);
  }
  const bool isKnown = static_cast<bool>(used);
  // One that is known may have been repaired.
  auto summary = isKnown && !strict ? services.store.summary(pack->id) : std::nullopt;
  if (!isKnown) {
    if (const auto room = services.store.checkRoom(pack->bytes); !room) {
      return problemReply(room.problems(), call.request.id); // before a worker loads it
    }
  }
  if (!summary) {
    HttpReply loaded = loadScene(services, call, pack->id, {pack->file}, strict);
    if (loaded.status != 200) return loaded;
    const auto kept = services.store.put(pack->id, pack->file, pack->bytes, std::string(loaded.body));
    if (!kept) return problemReply(kept.problems(), call.request.id);
    isNew = *kept;
    if (!isNew) services.store.keepSummary(pack->id, std::string(loaded.body)); // the one beside it could not be used
    summary = std::string(loaded.body);
  }
  HttpReply reply = summaryReply(*std::move(summary), isNew ? 201 : 200);
  reply.headers.emplace_back("Location", "/v1/scenes/" + pack->id);
  return reply;
}

/// The scene's summary as it was stored, or as a worker makes it.
HttpReply summaryOf(Services& services, const RouteCall& call, const std::string& id) {
  if (const auto there = services.store.contains(id); !there) return problemReply(there.problems(), call.request.id);
  if (auto stored = services.store.summary(id)) return summaryReply(*std::move(stored));
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  HttpReply made = loadScene(services, call, id, *std::move(bundle));
  if (made.status == 200) services.store.keepSummary(id, std::string(made.body));
  return made;
}

constexpr std::size_t kPageBytes = 8 << 20; ///< a page with more summaries than that ends early

struct PageQuery {
  std::size_t limit = 100;
  std::string after;
};

Result<PageQuery> pageQuery(const Query& query) {
  constexpr int kMost = 1000;
  PageQuery page;
  const auto limit = queryNumber(query, "limit", 1, kMost, "This is no number of scenes for a page.");
  if (!limit) return limit.problems();
  if (*limit) page.limit = static_cast<std::size_t>(**limit);
  page.after = queryText(query, "after").value_or("");
  if (queryText(query, "after") && !isSceneId(page.after)) {
    return Problem{ProblemCode::invalidValue, "/after", "This is not what a page gave as its next.",
                   "64 lower-case hexadecimal digits", asciiExcerpt(page.after)};
  }
  return page;
}

Result<NodePage> pageOf(const Query& query) {
  constexpr auto kWrong = "This value is not possible for a page of nodes.";
  NodePage page;
  const auto limit = queryNumber(query, "limit", 1, kMostNodesOnPage, kWrong);
  const auto after = queryNumber(query, "after", 0, static_cast<int>(kLimits.maxNodes), kWrong);
  for (const auto* read : {&limit, &after}) {
    if (!*read) return read->problems();
  }
  page.limit = limit->value_or(page.limit);
  page.after = after->value_or(page.after);
  return page;
}

} // namespace

HttpReply postScene(Services& services, RouteCall call) {
  return store(services, call, std::nullopt);
}

HttpReply putScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (!isSceneId(id)) {
    return problemReply({{ProblemCode::invalidValue, "id", "The path must end with the SHA-256 of the upload.",
                          "64 lower-case hexadecimal digits", asciiExcerpt(id)}},
                        call.request.id);
  }
  return store(services, call, id);
}

HttpReply listScenes(Services& services, RouteCall call) {
  const auto query = pageQuery(call.request.query);
  if (!query) return problemReply(query.problems(), call.request.id);
  const auto page = services.store.page(query->after, query->limit);
  if (!page) return problemReply(page.problems(), call.request.id);
  std::string all;
  std::string last; // of those that the page has dealt with
  bool hasMore = page->hasMore;
  for (const std::string& id : page->ids) {
    if (all.size() > kPageBytes) {
      hasMore = true;
      break;
    }
    HttpReply summary = summaryOf(services, call, id);
    if (summary.status == 429 || summary.status >= 500) { // it had to be loaded: the next page begins with it
      if (last.empty()) return summary;
      hasMore = true;
      break;
    }
    if (summary.status == 200) all.append(all.empty() ? "" : ",").append(summary.body);
    last = id;
  }
  if (!hasMore) return summaryReply("{\"scenes\":[" + all + "]}");
  HttpReply reply = summaryReply("{\"scenes\":[" + all + "],\"next\":\"" + last + "\"}");
  reply.headers.emplace_back(
      "Link", "</v1/scenes?limit=" + std::to_string(query->limit) + "&after=" + last + ">; rel=\"next\"");
  return reply;
}

HttpReply getScene(Services& services, RouteCall call) {
  return summaryOf(services, call, call.values.at("id"));
}

HttpReply deleteScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (const auto removed = services.store.remove(id); !removed) {
    return problemReply(removed.problems(), call.request.id);
  }
  services.workers.forget(id);
  HttpReply reply;
  reply.status = 204;
  return reply;
}

HttpReply getNodes(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), call.request.id);
  const auto page = pageOf(call.request.query);
  if (!page) return problemReply(page.problems(), call.request.id);
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  Task task = taskFor(call, OrderKind::nodes, id, *std::move(bundle), jsonText(toJson(*page)), services.requestTimeout);
  HttpReply reply = replyOf(runTask(services, std::move(task), call.clientGone), call.request.id);
  if (reply.status == 200)
    reply.headers.emplace_back("Cache-Control", "private, max-age=86400"); // its id names its bytes
  return reply;
}

} // namespace gnomon
