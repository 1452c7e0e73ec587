#include "server/handlers/routes.h"

#include <algorithm>
#include <memory>

#include "server/handlers/evaluation_handlers.h"
#include "server/handlers/frame_handlers.h"
#include "server/handlers/info_handlers.h"
#include "server/handlers/plan_handlers.h"
#include "server/handlers/scenes_handlers.h"
#include "server/http/ascii.h"
#include "server/http/problem_reply.h"

namespace gnomon {
namespace {

std::variant<RouteMatch, HttpReply> findRoute(const Router& router, const HttpRequest& request) {
  auto found = router.find(request.method, request.path);
  if (auto* match = std::get_if<RouteMatch>(&found)) {
    return std::move(*match);
  }
  if (const auto* refused = std::get_if<MethodRefused>(&found)) {
    HttpReply reply = problemReply({{ProblemCode::methodNotAllowed, "", "This address does not take this method.",
                                     refused->allow, asciiExcerpt(request.method)}},
                                   request.id);
    reply.headers.emplace_back("Allow", refused->allow);
    return reply;
  }
  return problemReply(
      {{ProblemCode::notFound, "", "Nothing has this address; /openapi.json lists what there is.", "", ""}},
      request.id);
}

/// Told by the head alone: a body follows.
bool bringsBody(const HttpRequest& request) {
  return headerValue(request.headers, "transfer-encoding") ||
         headerValue(request.headers, "content-length").value_or("0") != "0";
}

std::variant<BodyRule, HttpReply> admit(const Router& router, const HttpRequest& request) {
  auto found = findRoute(router, request);
  if (auto* refused = std::get_if<HttpReply>(&found)) {
    return std::move(*refused);
  }
  const Route& route = *std::get<RouteMatch>(found).route;
  if (!route.contentTypes.empty() && bringsBody(request)) {
    const std::string type = mediaType(headerValue(request.headers, "content-type").value_or(""));
    if (std::find(route.contentTypes.begin(), route.contentTypes.end(), type) == route.contentTypes.end()) {
      std::string taken;
      for (const std::string& each : route.contentTypes) {
        taken += taken.empty() ? each : ", " + each;
      }
      return problemReply({{ProblemCode::unsupportedMediaType, "", "This route does not take this Content-Type.", taken,
                            asciiExcerpt(type)}},
                          request.id);
    }
    if (headerValue(request.headers, "content-encoding").value_or("identity") != "identity") {
      return problemReply({{ProblemCode::unsupportedMediaType, "", "Compressed bodies are not taken.", "identity", ""}},
                          request.id);
    }
  }
  return route.body;
}

} // namespace

std::vector<Route> makeRoutes(Services& services) {
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
      {"POST", "/v1/scenes", upload, sceneTypes, bind(postScene)},
      {"GET", "/v1/scenes", none, {}, bind(listScenes)},
      {"PUT", "/v1/scenes/{id}", upload, sceneTypes, bind(putScene)},
      {"GET", "/v1/scenes/{id}", none, {}, bind(getScene)},
      {"DELETE", "/v1/scenes/{id}", none, {}, bind(deleteScene)},
      {"POST", "/v1/scenes/{id}/frames", json, {"application/json"}, bind(postFrame)},
      {"GET", "/v1/scenes/{id}/frame", none, {}, bind(getFrame)},
      {"POST", "/v1/scenes/{id}/plan", json, {"application/json"}, bind(postPlan)},
      {"POST", "/v1/scenes/{id}/evaluations", json, {"application/json"}, bind(postEvaluation)},
      {"POST", "/v1/render", oneShot, {"multipart/form-data"}, bind(renderOnce)},
      {"GET", "/v1/capabilities", none, {}, bind(getCapabilities)},
      {"GET", "/openapi.json", none, {}, bind(getOpenApi)},
      {"GET", "/livez", none, {}, bind(getLivez), true},
      {"GET", "/readyz", none, {}, bind(getReadyz), true},
  };
  for (const StaticFile& file : services.page) {
    routes.push_back({"GET", std::string(file.path), none, {}, pageHandler(file)});
  }
  return routes;
}

HttpService makeService(Services& services) {
  const auto router = std::make_shared<const Router>(makeRoutes(services));
  HttpService service;
  service.admit = [router](const HttpRequest& request) { return admit(*router, request); };
  service.handle = [router](HttpRequest request, const std::function<bool()>& clientGone) {
    auto found = findRoute(*router, request);
    if (auto* refused = std::get_if<HttpReply>(&found)) {
      return std::move(*refused);
    }
    auto& match = std::get<RouteMatch>(found);
    return match.route->handler({std::move(request), std::move(match.values), clientGone});
  };
  service.isProbe = [router](const HttpRequest& request) {
    const auto found = router->find(request.method, request.path);
    const auto* match = std::get_if<RouteMatch>(&found);
    return match != nullptr && match->route->probe;
  };
  return service;
}

} // namespace gnomon
