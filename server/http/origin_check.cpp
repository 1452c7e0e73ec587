#include "server/http/origin_check.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cstdint>
#include <memory>
#include <netinet/in.h>
#include <string_view>
#include <utility>

#include "protocol/base/text.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

/// What a page may read of a reply beside its body, and what it may send.
constexpr const char* kExposed =
    "ETag, Gnomon-Warnings, Location, Retry-After, Server-Timing, X-Request-ID, traceresponse";
constexpr const char* kAccepted =
    "Accept, Authorization, Content-Type, If-Match, If-None-Match, X-Request-ID, traceparent, tracestate";
constexpr const char* kPreflightSeconds = "600";

bool isAddress(std::string_view host, int family) {
  std::array<unsigned char, sizeof(in6_addr)> bytes;
  return ::inet_pton(family, std::string(host).c_str(), bytes.data()) == 1;
}

bool isAddress(std::string_view host) {
  return isAddress(host, AF_INET) || isAddress(host, AF_INET6);
}

/// The host of "host" or "host:port", without the brackets of an IPv6 address; empty where it is neither.
std::string_view hostOf(std::string_view authority) {
  const bool isBracketed = authority.starts_with('[');
  const std::size_t end = std::min(authority.find(isBracketed ? ']' : ':'), authority.size());
  const std::string_view host = authority.substr(isBracketed ? 1 : 0, isBracketed ? end - 1 : end);
  std::string_view rest = authority.substr(std::min(end + (isBracketed ? 1 : 0), authority.size()));
  if (isBracketed && (end == authority.size() || !isAddress(host, AF_INET6))) return {};
  if (rest.empty()) return host;
  if (!rest.starts_with(':')) return {};
  rest.remove_prefix(1);
  return rest.empty() || numberIn<std::uint16_t>(rest) ? host : std::string_view();
}

bool isWildcard(std::string_view bind) {
  return bind == "0.0.0.0" || bind == "::";
}

bool isListed(const std::vector<std::string>& list, std::string_view name) {
  return std::any_of(list.begin(), list.end(),
                     [&](const std::string& each) { return each == "*" || lowerCase(each) == name; });
}

class OriginCheck {
 public:
  OriginCheck(HttpService service, OriginRules rules) : service_(std::move(service)), rules_(std::move(rules)) {}

  std::variant<RequestHandler, HttpReply> operator()(const HttpRequest& request) const {
    auto found = service_(request);
    auto* handler = std::get_if<RequestHandler>(&found);
    if (handler != nullptr && handler->isProbe) return found;
    const auto refuse = [&](Problem problem) {
      HttpReply reply = problemReply({std::move(problem)}, request.id, {.refusal = RefusalReason::origin});
      reply.route = handler != nullptr ? handler->route : std::get<HttpReply>(found).route;
      return reply;
    };
    const std::string host = lowerCase(headerValue(request.headers, "host").value_or(""));
    if (!isKnownHost(host)) {
      return refuse({ProblemCode::misdirected, "Host", "This server is not known by this name.",
                     "an address, localhost, or a name of --allowed-hosts", asciiExcerpt(host)});
    }
    const std::string origin = lowerCase(headerValue(request.headers, "origin").value_or(""));
    const bool isAllowed = !origin.empty() && isListed(rules_.allowedOrigins, origin);
    if (!isAllowed && isCrossSite(request, host, origin)) {
      return refuse({ProblemCode::forbidden, "Origin", "Pages of this origin may not send this request.",
                     "the server's own page, or an origin of --allowed-origins", asciiExcerpt(origin)});
    }
    if (rules_.allowedOrigins.empty()) return found;
    const std::string reader = isAllowed ? origin : "";
    if (handler != nullptr) {
      handler->answer = [answer = handler->answer, reader](HttpRequest asked, const std::function<bool()>& clientGone) {
        HttpReply made = answer(std::move(asked), clientGone);
        shareWith(reader, made);
        return made;
      };
    } else {
      auto& reply = std::get<HttpReply>(found);
      shareWith(reader, reply);
      if (request.method == "OPTIONS" && isAllowed) addPreflight(reply);
    }
    return found;
  }

 private:
  bool isKnownHost(const std::string& host) const {
    const std::string_view name = hostOf(host);
    return host.empty() || isAddress(name) || name == "localhost" || name == lowerCase(rules_.bind) ||
           (rules_.allowedHosts.empty() && isWildcard(rules_.bind)) || isListed(rules_.allowedHosts, host) ||
           isListed(rules_.allowedHosts, name);
  }

  /// A request that may change something, sent for a page of another server.
  static bool isCrossSite(const HttpRequest& request, const std::string& host, const std::string& origin) {
    if (request.method == "GET" || request.method == "HEAD" || request.method == "OPTIONS") return false;
    if (!origin.empty()) {
      const std::size_t scheme = origin.find("://"); // which a proxy may have changed
      return scheme == std::string::npos || origin.substr(scheme + 3) != host;
    }
    return lowerCase(headerValue(request.headers, "sec-fetch-site").value_or("")) == "cross-site";
  }

  /// `reader`: the allowed origin whose page asks, or nothing.
  static void shareWith(const std::string& reader, HttpReply& reply) {
    reply.headers.emplace_back("Vary", "Origin");
    if (!reader.empty()) {
      reply.headers.emplace_back("Access-Control-Allow-Origin", reader);
      reply.headers.emplace_back("Access-Control-Expose-Headers", kExposed);
    }
  }

  static void addPreflight(HttpReply& reply) {
    const auto allow = std::find_if(reply.headers.begin(), reply.headers.end(),
                                    [](const auto& header) { return header.first == "Allow"; });
    if (allow != reply.headers.end()) {
      const std::string methods = allow->second;
      reply.headers.emplace_back("Access-Control-Allow-Methods", methods);
      reply.headers.emplace_back("Access-Control-Allow-Headers", kAccepted);
      reply.headers.emplace_back("Access-Control-Max-Age", kPreflightSeconds);
    }
  }

  HttpService service_;
  OriginRules rules_;
};

} // namespace

HttpService withOriginCheck(HttpService service, OriginRules rules) {
  return [check = std::make_shared<const OriginCheck>(std::move(service), std::move(rules))](
             const HttpRequest& request) { return (*check)(request); };
}

} // namespace gnomon
