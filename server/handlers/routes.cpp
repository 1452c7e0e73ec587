#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/openapi/openapi.h"
#include "server/handlers/handlers.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"
#include "server/metrics/request_metrics.h"

namespace gnomon {
namespace {

/// The page may only run its own scripts and styles, talk to this server and show its pictures.
constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

HttpReply probeReply(std::string text) {
  HttpReply reply;
  reply.contentType = "text/plain; charset=utf-8";
  reply.body = std::move(text);
  reply.headers.emplace_back("Cache-Control", "no-store");
  return reply;
}

HttpReply getCapabilities(Services& services, RouteCall) {
  return jsonReply(toJson(Capabilities{GNOMON_VERSION, services.workers.info(), services.limits}));
}

HttpReply getOpenApi(Services&, RouteCall) {
  return jsonReply(openApi());
}

/// 200 while the process answers at all.
HttpReply getLivez(Services&, RouteCall) {
  return probeReply("alive\n");
}

/// 503 while the server drains, the queue is nearly full, or there was no worker or thread for a request for so long
/// that none is about to come: a worker that is being replaced, and a crowd that passes, are no reason.
HttpReply getReadyz(Services& services, RouteCall call) {
  constexpr std::chrono::seconds kPatience{5};
  const DispatcherState state = services.workers.state();
  const StoreState store = services.store.state();
  const auto lacking = services.lackingThreads ? services.lackingThreads->duration() : Clock::duration();
  const char* reason = services.draining                      ? "The server is shutting down."
                       : state.noneReadyFor > kPatience       ? "No worker is ready."
                       : state.waiting * 4 >= state.limit * 3 ? "The queue before the workers is nearly full."
                       : lacking > kPatience                  ? "Requests find no thread."
                       : !store.isReachable && store.inMemory.scenes == 0
                           ? "The store can't be reached, and no scene is in memory."
                           : nullptr;
  if (reason != nullptr) return problemReply({{ProblemCode::unavailable, "", reason, "", ""}}, call.request.id);
  return probeReply(store.isReachable ? "ready\n"
                                      : "ready, but for scenes that are not in memory: the store's Redis is away\n");
}

HttpReply getMetrics(Services& services, RouteCall) {
  HttpReply reply;
  reply.contentType = metrics::kTextFormat;
  reply.body = services.metrics();
  reply.headers.emplace_back("Cache-Control", "no-store");
  return reply;
}

/// A route whose handler sees the services, and takes no body. Programs that watch servers may add a query.
Route plainRoute(Services& services, const char* path, Scope scope, HttpReply (*handler)(Services&, RouteCall)) {
  return {"GET",
          path,
          scope,
          {},
          {},
          [&services, handler](RouteCall call) { return handler(services, std::move(call)); },
          QueryKeys::any()};
}

Route probeRoute(Services& services, const char* path, HttpReply (*handler)(Services&, RouteCall)) {
  Route route = plainRoute(services, path, Scope::none, handler);
  route.probe = true;
  return route;
}

/// A route whose handler checks the request's preconditions.
Route tagged(Route route) {
  route.hasTag = true;
  return route;
}

/// A handler for one file of the web page.
std::function<HttpReply(RouteCall)> pageHandler(const StaticFile& file) {
  Sha256 hash;
  hash.add(file.bytes);
  return [file, etag = '"' + hash.hex() + '"'](const RouteCall& call) {
    const Precondition condition = preconditionOf(call.request.headers, etag);
    if (condition == Precondition::failed) {
      return problemReply({preconditionFailed(call.request.headers, etag)}, call.request.id);
    }
    HttpReply reply;
    reply.headers = {{"ETag", etag},
                     {"Cache-Control", "no-cache"},
                     {"Content-Security-Policy", std::string(kPagePolicy)},
                     {"Referrer-Policy", "no-referrer"}};
    if (condition != Precondition::holds) {
      reply.status = 304;
      return reply;
    }
    reply.contentType = file.contentType;
    reply.body = file.bytes;
    return reply;
  };
}

std::variant<RouteMatch, HttpReply> findRoute(const Router& router, const HttpRequest& request) {
  const auto allows = [](const std::string& methods) {
    HttpReply reply;
    reply.status = 204;
    reply.headers.emplace_back("Allow", methods);
    return reply;
  };
  if (request.target == kWholeServer) return allows(router.allow());
  auto found = router.find(request.method, request.path);
  if (auto* match = std::get_if<RouteMatch>(&found)) return std::move(*match);
  if (const auto* refused = std::get_if<MethodRefused>(&found)) {
    if (request.method == "OPTIONS") return allows(refused->allow);
    HttpReply reply = problemReply({{ProblemCode::methodNotAllowed, "", "This path does not support this method.",
                                     refused->allow, asciiExcerpt(request.method)}},
                                   request.id);
    reply.headers.emplace_back("Allow", refused->allow);
    return reply;
  }
  return problemReply({{ProblemCode::notFound, "", "No route has this path; /openapi.json lists all of them.", "", ""}},
                      request.id);
}

/// Why this route does not accept the body that the request's head announces.
std::optional<Problem> refuseContent(const Route& route, const HttpRequest& request) {
  if (route.contentTypes.empty() || !request.hasBody) return std::nullopt;
  const std::string type = mediaType(headerValue(request.headers, "content-type").value_or(""));
  if (std::find(route.contentTypes.begin(), route.contentTypes.end(), type) == route.contentTypes.end()) {
    std::string accepted;
    for (const std::string& each : route.contentTypes) {
      accepted += accepted.empty() ? each : ", " + each;
    }
    return Problem{ProblemCode::unsupportedMediaType, "", "This route does not accept this Content-Type.", accepted,
                   asciiExcerpt(type)};
  }
  if (headerValue(request.headers, "content-encoding").value_or("identity") != "identity") {
    return Problem{ProblemCode::unsupportedMediaType, "", "Compressed bodies are not accepted.", "identity", ""};
  }
  return std::nullopt;
}

} // namespace

std::vector<Route> makeRoutes(Services& services, Addresses addresses) {
  const BodyRule none;
  const BodyRule json{BodyRule::Framing::length, services.limits.maxSpecBytes};
  constexpr std::size_t kFormFraming = 1 << 20; // boundaries and part headers
  const BodyRule upload{BodyRule::Framing::any, services.limits.maxSceneBytes + kFormFraming};
  const BodyRule oneShot{BodyRule::Framing::any, upload.maxBytes + services.limits.maxSpecBytes};
  const std::vector<std::string> sceneTypes{"model/gltf-binary", "model/gltf+json", "multipart/form-data"};

  const auto bind = [&services](HttpReply (*handler)(Services&, RouteCall)) {
    return [&services, handler](RouteCall call) { return handler(services, std::move(call)); };
  };
  std::vector<Route> routes{
      {"POST", "/v1/scenes", Scope::upload, upload, sceneTypes, bind(postScene), {"strict"}},
      {"GET", "/v1/scenes", Scope::read, none, {}, bind(listScenes), {"limit", "after"}},
      {"PUT", "/v1/scenes/{id}", Scope::upload, upload, sceneTypes, bind(putScene), {"strict"}},
      {"GET", "/v1/scenes/{id}", Scope::read, none, {}, bind(getScene)},
      {"DELETE", "/v1/scenes/{id}", Scope::upload, none, {}, bind(deleteScene)},
      {"GET", "/v1/scenes/{id}/nodes", Scope::read, none, {}, bind(getNodes), {"limit", "after"}},
      tagged({"POST", "/v1/scenes/{id}/frames", Scope::render, json, {"application/json"}, bind(postFrame)}),
      tagged({"GET", "/v1/scenes/{id}/frame", Scope::render, none, {}, bind(getFrame), QueryKeys::any(), false, true}),
      {"POST", "/v1/scenes/{id}/plan", Scope::render, json, {"application/json"}, bind(postPlan)},
      {"POST", "/v1/scenes/{id}/evaluations", Scope::render, json, {"application/json"}, bind(postEvaluation)},
      {"POST", "/v1/scenes/{id}/sequences", Scope::render, json, {"application/json"}, bind(postSequence)},
      {"GET", "/v1/jobs", Scope::render, none, {}, bind(listJobs)},
      {"GET", "/v1/jobs/{id}", Scope::render, none, {}, bind(getJob), {"wait"}},
      {"DELETE", "/v1/jobs/{id}", Scope::render, none, {}, bind(deleteJob)},
      {"GET", "/v1/jobs/{id}/result", Scope::render, none, {}, bind(getJobResult)},
      tagged({"GET", "/v1/jobs/{id}/frames/{index}", Scope::render, none, {}, bind(getJobFrame)}),
      {"POST", "/v1/scenes/{id}/bakes", Scope::render, json, {"application/json"}, bind(postBake)},
      {"GET", "/v1/scenes/{id}/bakes/{key}", Scope::render, none, {}, bind(getBake), {"light"}},
      {"DELETE", "/v1/scenes/{id}/bakes/{key}", Scope::render, none, {}, bind(deleteBake)},
      tagged({"POST",
              "/v1/render",
              Scope::upload | Scope::render,
              oneShot,
              {"multipart/form-data"},
              bind(renderOnce),
              {"strict"}}),
      {"POST", "/render", Scope::upload | Scope::render, oneShot, {"multipart/form-data"}, bind(renderDrake)},
      plainRoute(services, "/v1/capabilities", Scope::read, getCapabilities),
      plainRoute(services, "/openapi.json", Scope::none, getOpenApi),
      probeRoute(services, "/livez", getLivez),
      probeRoute(services, "/readyz", getReadyz),
  };
  if (addresses == Addresses::one) routes.push_back(plainRoute(services, "/metrics", Scope::admin, getMetrics));
  for (const StaticFile& file : services.page) {
    routes.push_back({"GET",
                      std::string(file.path),
                      Scope::none,
                      none,
                      {},
                      pageHandler(file),
                      QueryKeys::any(),
                      false,
                      false,
                      "page",
                      true});
  }
  return routes;
}

std::vector<Route> makeAdminRoutes(Services& services) {
  return {plainRoute(services, "/metrics", Scope::admin, getMetrics), probeRoute(services, "/livez", getLivez),
          probeRoute(services, "/readyz", getReadyz)};
}

HttpService makeService(std::vector<Route> routes) {
  const auto router = std::make_shared<const Router>(std::move(routes));
  return [router](const HttpRequest& head) -> std::variant<RequestHandler, HttpReply> {
    auto found = findRoute(*router, head);
    if (auto* refused = std::get_if<HttpReply>(&found)) return std::move(*refused);
    auto& match = std::get<RouteMatch>(found);
    const Route& route = *match.route;
    const std::string& name = route.name.empty() ? route.pattern : route.name;
    Problems problems = route.query.check(head.query);
    if (auto problem = refuseContent(route, head)) problems.push_back(*std::move(problem));
    if (!problems.empty()) {
      HttpReply refused = problemReply(problems, head.id);
      refused.route = name;
      return refused;
    }
    // The handler keeps the router, whose route it calls.
    return RequestHandler{route.body,
                          route.scope,
                          route.takesSignature,
                          name,
                          route.probe,
                          [router, &route, values = std::move(match.values)](HttpRequest request,
                                                                             const std::function<bool()>& clientGone) {
                            if (!route.hasTag && preconditionOf(request.headers, "") == Precondition::failed) {
                              return problemReply({preconditionFailed(request.headers, "")}, request.id);
                            }
                            return route.handler({std::move(request), values, clientGone});
                          }};
  };
}

} // namespace gnomon
