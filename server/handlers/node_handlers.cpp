#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "protocol/json/node_json.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

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
