#include "server/access/access_check.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "protocol/access/access_key.h"
#include "protocol/base/text.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

constexpr std::string_view kChallenge = "Bearer realm=\"gnomon\"";
constexpr std::string_view kScheme = "bearer ";

HttpReply unauthorized(std::string detail, std::string_view challengeMore, const HttpRequest& request) {
  HttpReply reply = problemReply(
      {{ProblemCode::unauthorized, "Authorization", std::move(detail), "Bearer and the secret of a key", ""}},
      request.id, {.refusal = RefusalReason::keys});
  reply.headers.emplace_back("WWW-Authenticate", std::string(kChallenge).append(challengeMore));
  return reply;
}

HttpReply notSigned(std::string_view queryKey, std::string detail, const HttpRequest& request) {
  return problemReply({{ProblemCode::forbidden, std::string(queryKey), std::move(detail), "", ""}}, request.id,
                      {.refusal = RefusalReason::keys});
}

bool hasSignature(const HttpRequest& request) {
  return std::any_of(request.query.begin(), request.query.end(),
                     [](const auto& pair) { return pair.first == kSignatureKey; });
}

/// What signing added says nothing about the frame.
void dropSignature(HttpRequest& request) {
  std::erase_if(request.query, [](const auto& pair) {
    return pair.first == kExpiresKey || pair.first == kNameKey || pair.first == kSignatureKey;
  });
}

HttpReply outOfScope(const AccessKey& key, Scope needed, const HttpRequest& request) {
  HttpReply reply = problemReply({{ProblemCode::forbidden, "Authorization", "This key does not allow this request.",
                                   scopeText(needed), scopeText(key.scope)}},
                                 request.id, {.refusal = RefusalReason::keys});
  reply.key = key.name;
  return reply;
}

HttpReply tooOften(const AccessKey& key, int seconds, const HttpRequest& request) {
  HttpReply reply = problemReply(
      {{ProblemCode::busy, "Authorization", "This key has as many requests as it may have for now.", "", ""}},
      request.id, {.retryAfterSeconds = seconds, .refusal = RefusalReason::rate});
  reply.key = key.name;
  return reply;
}

/// A reply that is made while it is sent, or waits, is in progress until then.
void holdWhileSent(HttpReply& reply, const std::shared_ptr<void>& place) {
  if (reply.stream) {
    reply.stream = [stream = std::move(reply.stream), place](const BodySink& sink) { return stream(sink); };
  }
  if (reply.later) {
    reply.later = [later = std::move(reply.later), place] { return later(); };
  }
}

std::int64_t secondsSince1970() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()).time_since_epoch().count();
}

/// What was made for one client must not be handed to others, and is kept no longer than its address is valid.
/// `expires`: seconds since 1970; nothing = the address needs none.
void keepPrivate(HttpReply& reply, std::optional<std::int64_t> expires) {
  constexpr std::string_view kPublic = "public", kAge = "max-age=";
  for (auto& [name, value] : reply.headers) {
    if (name != "Cache-Control") continue;
    if (value.starts_with(kPublic)) value.replace(0, kPublic.size(), "private");
    const std::size_t age = value.find(kAge);
    if (!expires || age == std::string::npos) continue;
    const std::size_t begin = age + kAge.size();
    const std::size_t end = std::min(value.find_first_not_of("0123456789", begin), value.size());
    const auto allowed = numberIn<std::int64_t>(std::string_view(value).substr(begin, end - begin));
    const std::int64_t left = std::max<std::int64_t>(*expires - secondsSince1970(), 0);
    value.replace(begin, end - begin, std::to_string(std::min(allowed.value_or(0), left)));
  }
}

class AccessCheck {
 public:
  AccessCheck(HttpService service, std::shared_ptr<KeyRing> keys)
      : service_(std::move(service)), keys_(std::move(keys)) {}

  std::variant<RequestHandler, HttpReply> operator()(const HttpRequest& request) const {
    auto found = service_(request);
    auto* handler = std::get_if<RequestHandler>(&found);
    if (handler == nullptr || handler->scope == Scope::none) return found;
    const bool isSigned = handler->takesSignature && hasSignature(request);
    const auto target = isSigned ? readSignedTarget(request.target) : std::nullopt;
    const auto expires = target ? std::optional(target->expires) : std::nullopt;
    const auto refuse = [&](HttpReply reply) {
      reply.route = handler->route;
      return reply;
    };
    auto known = isSigned ? keyOfSignature(request, target) : keyOfHeader(request);
    if (auto* refused = std::get_if<HttpReply>(&known)) return refuse(std::move(*refused));
    auto& key = std::get<AccessKey>(known);
    if (!allows(key.scope, handler->scope)) return refuse(outOfScope(key, handler->scope, request));
    // Before its body is read; when it is there, another request may have been quicker.
    if (const int seconds = usage_->wait(key); seconds > 0) return refuse(tooOften(key, seconds, request));
    handler->answer = [usage = usage_, answer = std::move(handler->answer), key, isSigned, expires](
                          HttpRequest asked, const std::function<bool()>& clientGone) {
      Admission admission = usage->admit(key);
      if (!admission.place) return tooOften(key, admission.retryAfterSeconds, asked);
      if (isSigned) dropSignature(asked);
      const ClientIdentity client{"key " + key.name, "key " + key.name};
      asked.client = client;
      asked.key = key.name;
      asked.isAdmin = allows(key.scope, Scope::admin);
      HttpReply reply = answer(std::move(asked), clientGone);
      reply.key = key.name;
      reply.client = client;
      keepPrivate(reply, expires);
      holdWhileSent(reply, admission.place);
      return reply;
    };
    return found;
  }

 private:
  std::variant<AccessKey, HttpReply> keyOfHeader(const HttpRequest& request) const {
    const auto shown = headerValue(request.headers, "authorization");
    if (!shown) return unauthorized("This server asks for a key.", "", request);
    std::string_view secret = *shown;
    if (lowerCase(secret.substr(0, kScheme.size())) != kScheme) {
      return unauthorized("The Authorization is not of the kind that this server takes.", "", request);
    }
    secret.remove_prefix(kScheme.size());
    auto key = keys_->withSecret(trimmed(secret));
    if (!key) return unauthorized("No key has this secret.", ", error=\"invalid_token\"", request);
    return *std::move(key);
  }

  std::variant<AccessKey, HttpReply> keyOfSignature(const HttpRequest& request,
                                                    const std::optional<SignedTarget>& target) const {
    auto key = target ? keys_->named(target->key) : std::nullopt;
    if (!key || std::none_of(key->signingSecrets.begin(), key->signingSecrets.end(),
                             [&](const std::string& secret) { return isSignedBy(*target, secret); })) {
      return notSigned(kSignatureKey, "No key has signed this address as it is.", request);
    }
    if (secondsSince1970() >= target->expires)
      return notSigned(kExpiresKey, "The time of this address is over.", request);
    return *std::move(key);
  }

  HttpService service_;
  std::shared_ptr<KeyRing> keys_;
  std::shared_ptr<KeyUsage> usage_ = std::make_shared<KeyUsage>();
};

} // namespace

HttpService withAccessCheck(HttpService service, std::shared_ptr<KeyRing> keys) {
  return [check = std::make_shared<const AccessCheck>(std::move(service), std::move(keys))](
             const HttpRequest& request) { return (*check)(request); };
}

} // namespace gnomon
