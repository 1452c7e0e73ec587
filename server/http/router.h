#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/http/http_reply.h"
#include "server/http/http_request.h"
#include "server/http/request_body.h"

namespace gnomon {

/// What the braces in a route's pattern stood for, by name.
using PathValues = std::map<std::string, std::string, std::less<>>;

/// What a handler is given besides the request.
struct RouteCall {
  HttpRequest request;
  PathValues values;
  std::function<bool()> clientGone;
};

struct Route {
  std::string method;  ///< GET answers HEAD too, unless a route of its own does
  std::string pattern; ///< "/v1/scenes/{id}/frames"
  BodyRule body;
  std::vector<std::string> contentTypes; ///< media types taken; empty = any, or no body
  std::function<HttpReply(RouteCall)> handler;
  bool probe = false; ///< answered however busy everything else is
};

/// Where a request goes.
struct RouteMatch {
  const Route* route = nullptr;
  PathValues values;
};

/// The reply's Allow header, when the path exists and the method does not.
struct MethodRefused {
  std::string allow;
};
struct NoSuchPath {};

/// Matches segment by segment, literal segments before named ones; no regular expressions.
class Router {
 public:
  explicit Router(std::vector<Route> routes);

  std::variant<RouteMatch, MethodRefused, NoSuchPath> find(std::string_view method,
                                                           const std::vector<std::string>& path) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
  std::vector<std::vector<std::string>> patterns_; ///< segments, parallel to routes_
};

/// The media type of a Content-Type, lower case, without its parameters.
std::string mediaType(std::string_view contentType);

} // namespace gnomon
