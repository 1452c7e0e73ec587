#include "server/http/router.h"

#include <optional>
#include <set>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

std::vector<std::string> segmentsOf(std::string_view pattern) {
  return splitTrimmed(pattern.substr(1), '/'); // "/" has none
}

bool isName(std::string_view segment) {
  return segment.starts_with('{') && segment.ends_with('}');
}

std::optional<PathValues> matched(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
  if (pattern.size() != path.size()) return std::nullopt;
  PathValues values;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (isName(pattern[i])) {
      values.emplace(pattern[i].substr(1, pattern[i].size() - 2), path[i]);
    } else if (pattern[i] != path[i]) {
      return std::nullopt;
    }
  }
  return values;
}

void addMethods(const Route& route, std::set<std::string>& allowed) {
  allowed.insert(route.method);
  if (route.method == "GET") allowed.insert("HEAD");
}

/// The value of an Allow header.
std::string allowOf(std::set<std::string> methods) {
  methods.insert("OPTIONS");
  std::string allow;
  for (const std::string& name : methods) allow += allow.empty() ? name : ", " + name;
  return allow;
}

} // namespace

Router::Router(std::vector<Route> routes) : routes_(std::move(routes)) {
  for (const Route& route : routes_) {
    patterns_.push_back(segmentsOf(route.pattern));
  }
}

std::variant<RouteMatch, MethodRefused, NoSuchPath> Router::find(std::string_view method,
                                                                 const std::vector<std::string>& path) const {
  std::optional<RouteMatch> best;
  std::set<std::string> allowed;
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    auto values = matched(patterns_[i], path);
    if (!values) continue;
    const Route& route = routes_[i];
    addMethods(route, allowed);
    const bool exact = route.method == method;
    const bool asHead = method == "HEAD" && route.method == "GET";
    const bool better = !best || values->size() < best->values.size() ||
                        (values->size() == best->values.size() && exact && best->route->method != method);
    if ((exact || asHead) && better) best = RouteMatch{&route, *std::move(values)};
  }
  if (best) return *std::move(best);
  if (allowed.empty()) return NoSuchPath{};
  return MethodRefused{allowOf(std::move(allowed))};
}

std::string Router::allow() const {
  std::set<std::string> allowed;
  for (const Route& route : routes_) addMethods(route, allowed);
  return allowOf(std::move(allowed));
}

} // namespace gnomon
