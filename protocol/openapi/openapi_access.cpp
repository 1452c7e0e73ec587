#include <algorithm>
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "protocol/access/access_key.h"
#include "protocol/base/text.h"
#include "protocol/openapi/openapi_parts.h"

namespace gnomon::openapi {
namespace {

/// What a key must allow for an operation. Operations without a row need no key.
struct AccessRow {
  const char* path;
  const char* method;
  Scope scope;
  bool takesSignature = false;
};

constexpr std::array kAccess{
    AccessRow{"/v1/scenes", "get", Scope::read},
    AccessRow{"/v1/scenes", "post", Scope::upload},
    AccessRow{"/v1/scenes/{id}", "put", Scope::upload},
    AccessRow{"/v1/scenes/{id}", "get", Scope::read},
    AccessRow{"/v1/scenes/{id}", "head", Scope::read},
    AccessRow{"/v1/scenes/{id}", "delete", Scope::upload},
    AccessRow{"/v1/scenes/{id}/nodes", "get", Scope::read},
    AccessRow{"/v1/scenes/{id}/frames", "post", Scope::render},
    AccessRow{"/v1/scenes/{id}/frame", "get", Scope::render, true},
    AccessRow{"/v1/scenes/{id}/plan", "post", Scope::render},
    AccessRow{"/v1/scenes/{id}/evaluations", "post", Scope::render},
    AccessRow{"/v1/scenes/{id}/sequences", "post", Scope::render},
    AccessRow{"/v1/jobs", "get", Scope::render},
    AccessRow{"/v1/jobs/{id}", "get", Scope::render},
    AccessRow{"/v1/jobs/{id}", "delete", Scope::render},
    AccessRow{"/v1/jobs/{id}/result", "get", Scope::render},
    AccessRow{"/v1/jobs/{id}/frames/{index}", "get", Scope::render},
    AccessRow{"/v1/scenes/{id}/bakes", "post", Scope::render},
    AccessRow{"/v1/scenes/{id}/bakes/{key}", "get", Scope::render},
    AccessRow{"/v1/scenes/{id}/bakes/{key}", "delete", Scope::render},
    AccessRow{"/v1/render", "post", Scope::render | Scope::upload},
    AccessRow{"/render", "post", Scope::render | Scope::upload},
    AccessRow{"/v1/capabilities", "get", Scope::read},
    AccessRow{"/metrics", "get", Scope::admin},
};

/// These are answered under any name.
constexpr std::array<const char*, 2> kProbes{"/livez", "/readyz"};

void addReplies(Json& operation, std::initializer_list<const char*> statuses) {
  operation["responses"] = replies(std::move(operation["responses"]), statuses);
}

} // namespace

Json securitySchemes() {
  return {{"key",
           {{"type", "http"},
            {"scheme", "bearer"},
            {"description",
             "The secret of a key, where the server has keys. An operation lists the scopes that the key "
             "must have; a key of scope admin has all of them."}}},
          {"signature",
           {{"type", "apiKey"},
            {"in", "query"},
            {"name", "signature"},
            {"description",
             "An address that was signed with a key's signingSecret: `gnomon sign` appends expires, key "
             "and signature."}}}};
}

Json withAccess(Json paths) {
  for (const AccessRow& row : kAccess) {
    Json& operation = paths.at(row.path).at(row.method);
    // The empty requirement: a server without keys asks for none.
    operation["security"] = Json::array({Json::object(), {{"key", splitTrimmed(scopeText(row.scope), ',')}}});
    if (row.takesSignature) operation["security"].push_back({{"signature", Json::array()}});
    addReplies(operation, {"401", "403", "429"});
  }
  for (auto& [path, operations] : paths.items()) {
    const bool isProbe = std::find(kProbes.begin(), kProbes.end(), path) != kProbes.end();
    for (auto& [method, operation] : operations.items()) {
      if (!isProbe) addReplies(operation, {"421"});
    }
  }
  return paths;
}

} // namespace gnomon::openapi
