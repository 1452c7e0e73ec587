#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/node_json.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

struct PageKey {
  std::string_view name;
  int NodePage::*member;
  int least;
  int most;
};

constexpr PageKey kPageKeys[] = {
    {"limit", &NodePage::limit, 1, kMostNodesOnPage},
    {"after", &NodePage::after, 0, static_cast<int>(kLimits.maxNodes)},
};

Result<NodePage> pageOf(const HttpRequest& request) {
  NodePage page;
  std::string seen;
  for (const auto& [name, value] : request.query) {
    const std::string pointer = "/" + asciiExcerpt(name);
    const PageKey* key = nullptr;
    for (const PageKey& each : kPageKeys) {
      if (each.name == name) key = &each;
    }
    if (key == nullptr) {
      return Problem{ProblemCode::invalidValue, pointer, "There is no query key of this name.", "limit, after", ""};
    }
    if (seen.find(name) != std::string::npos) {
      return Problem{ProblemCode::invalidValue, pointer, "The query key is repeated.", "", ""};
    }
    seen += name + " ";
    int& number = page.*key->member;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || number < key->least || number > key->most) {
      return Problem{ProblemCode::invalidValue, pointer, "This value is not possible for a page of nodes.",
                     std::to_string(key->least) + ".." + std::to_string(key->most), asciiExcerpt(value)};
    }
  }
  return page;
}

} // namespace

HttpReply getNodes(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (const auto used = services.store.use(id); !used) return problemReply(used.problems(), call.request.id);
  const auto page = pageOf(call.request);
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
