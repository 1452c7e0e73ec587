#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/access/access_key.h"
#include "server/http/reply.h"
#include "server/http/request.h"
#include "server/http/request_body.h"
#include "server/http/url.h"

namespace gnomon {

/// The segments of the path that a pattern names in braces.
using PathValues = std::map<std::string, std::string, std::less<>>;

/// A request, with what the router and the connection add to it.
struct RouteCall {
  HttpRequest request;
  PathValues values;
  std::function<bool()> clientGone;
};

struct Route {
  std::string method;  ///< GET answers HEAD too, unless a route of its own does
  std::string pattern; ///< "/v1/scenes/{id}/frames"
  Scope scope;         ///< what a key must allow; none = anyone may ask
  BodyRule body;
  std::vector<std::string> contentTypes; ///< media types accepted; empty = any, or no body
  std::function<HttpReply(RouteCall)> handler;
  QueryKeys query{};
  bool probe = false;          ///< answered however busy everything else is
  bool takesSignature = false; ///< a signed address does instead of a key
  std::string name{};          ///< for metrics; empty = its pattern
  bool hasTag = false;         ///< its replies have entity tags, and its handler checks the preconditions
};

/// The route of a request.
struct RouteMatch {
  const Route* route = nullptr;
  PathValues values;
};

/// The path exists, but not with this method; `allow` is the reply's Allow header.
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

  std::string allow() const; ///< every method that some path has, as an Allow header

 private:
  std::vector<Route> routes_;
  std::vector<std::vector<std::string>> patterns_; ///< segments, parallel to routes_
};

} // namespace gnomon
