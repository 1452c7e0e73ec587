#include "protocol/openapi/openapi.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/json/json_codec.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

void forEachValue(const Json& value, const std::function<void(const std::string& key, const Json&)>& visit) {
  for (const auto& [key, inner] : value.items()) {
    visit(key, inner);
    if (inner.is_structured()) forEachValue(inner, visit);
  }
}

void forEachOperation(
    const Json& document,
    const std::function<void(const std::string& path, const std::string& method, const Json&)>& visit) {
  for (const auto& [path, item] : document["paths"].items()) {
    for (const auto& [method, operation] : item.items()) visit(path, method, operation);
  }
}

TEST(OpenApi, EveryReferenceLeadsSomewhereAndEveryComponentIsUsed) {
  const Json document = openApi();
  std::set<std::string> targets;
  forEachValue(document, [&](const std::string& key, const Json& value) {
    if (key != "$ref") return;
    const std::string target = value;
    ASSERT_EQ(target[0], '#');
    EXPECT_TRUE(document.contains(Json::json_pointer(target.substr(1)))) << target;
    targets.insert(target);
  });
  forEachOperation(document, [&](const std::string&, const std::string&, const Json& operation) {
    for (const Json& needed : operation.value("security", Json::array())) {
      for (const auto& [scheme, scopes] : needed.items()) targets.insert("#/components/securitySchemes/" + scheme);
    }
  });
  for (const auto& [kind, components] : document["components"].items()) {
    for (const auto& [name, component] : components.items()) {
      EXPECT_TRUE(targets.contains("#/components/" + kind + "/" + name)) << kind << " " << name;
    }
  }
}

TEST(OpenApi, HasEveryRoute) {
  const Json document = openApi();
  std::map<std::string, std::set<std::string>> routes;
  forEachOperation(
      document, [&](const std::string& path, const std::string& method, const Json&) { routes[path].insert(method); });
  std::string all;
  for (const auto& [path, methods] : routes) {
    all += path;
    for (const std::string& method : methods) all += " " + method;
    all += ", ";
  }
  EXPECT_EQ(all,
            "/ get, /livez get, /metrics get, /openapi.json get, /readyz get, /render post, /v1/capabilities get, "
            "/v1/jobs get, /v1/jobs/{id} delete get, /v1/jobs/{id}/frames/{index} get, /v1/jobs/{id}/result get, "
            "/v1/render post, /v1/scenes get post, /v1/scenes/{id} delete get head put, /v1/scenes/{id}/bakes post, "
            "/v1/scenes/{id}/bakes/{key} delete get, /v1/scenes/{id}/evaluations post, /v1/scenes/{id}/frame get, "
            "/v1/scenes/{id}/frames post, /v1/scenes/{id}/nodes get, /v1/scenes/{id}/plan post, "
            "/v1/scenes/{id}/sequences post, ");
}

TEST(OpenApi, EveryOperationHasItsOwnIdASummaryAndAGoodReply) {
  std::set<std::string> ids;
  forEachOperation(openApi(), [&](const std::string& path, const std::string& method, const Json& operation) {
    EXPECT_TRUE(ids.insert(operation.at("operationId")).second) << method << " " << path;
    EXPECT_FALSE(operation.at("summary").get<std::string>().empty());
    EXPECT_TRUE(operation["responses"].contains("200") || operation["responses"].contains("204")) << path;
  });
}

TEST(OpenApi, EveryPathParameterIsDeclared) {
  const Json document = openApi();
  forEachOperation(document, [&](const std::string& path, const std::string& method, const Json& operation) {
    std::set<std::string> declared;
    for (const Json& each : operation.value("parameters", Json::array())) {
      const std::string reference = each.value("$ref", "");
      const Json parameter = reference.empty() ? each : document.at(Json::json_pointer(reference.substr(1)));
      if (parameter.at("in") == "path") declared.insert(parameter.at("name").get<std::string>());
    }
    std::set<std::string> named;
    for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{', at + 1)) {
      named.insert(path.substr(at + 1, path.find('}', at) - at - 1));
    }
    EXPECT_EQ(declared, named) << method << " " << path;
  });
}

TEST(OpenApi, OperationsSayWhatElseOpensThem) {
  const Json document = openApi();
  EXPECT_TRUE(document["paths"]["/v1/scenes/{id}/frame"]["get"]["security"].at(2).contains("signature"));
  EXPECT_EQ(document["components"]["securitySchemes"]["key"]["scheme"], "bearer");
}

TEST(OpenApi, WhereWhoAsksMattersTheRepliesSaySo) {
  forEachOperation(openApi(), [&](const std::string& path, const std::string& method, const Json& operation) {
    const Json& responses = operation["responses"];
    for (const char* status : {"401", "403", "429"}) {
      const bool mayComeAnyway = std::string_view(status) == "429"; // of a full queue
      if (operation.contains("security") || !mayComeAnyway) {
        EXPECT_EQ(responses.contains(status), operation.contains("security")) << method << " " << path << " " << status;
      }
    }
    EXPECT_EQ(responses.contains("421"), path != "/livez" && path != "/readyz") << path;
  });
}

TEST(OpenApi, RoutesSayWhatBecomesOfThemWhereTheSceneHasToBeLoaded) {
  const Json document = openApi();
  const auto expectStatuses = [&](const char* path, const char* method, const std::set<std::string>& statuses) {
    const Json& responses = document["paths"][path][method]["responses"];
    for (const std::string& status : statuses) {
      EXPECT_TRUE(responses.contains(status)) << method << " " << path << " " << status;
    }
  };
  const std::set<std::string> ofWork{"413", "422", "429", "500", "503", "504"};
  expectStatuses("/v1/scenes", "post", ofWork);
  expectStatuses("/v1/scenes/{id}", "put", ofWork);
  expectStatuses("/v1/scenes/{id}", "get", ofWork);
  expectStatuses("/v1/scenes/{id}", "head", ofWork);
  expectStatuses("/v1/scenes/{id}/frames", "post", ofWork);
  expectStatuses("/v1/scenes/{id}/frame", "get", ofWork);
  expectStatuses("/v1/scenes/{id}/plan", "post", ofWork);
  expectStatuses("/v1/scenes/{id}", "delete", {"404", "503"});
}

TEST(OpenApi, EveryRouteThatReadsItsQueryMayRefuseIt) {
  const std::set<std::string> readNone{"/", "/v1/capabilities", "/openapi.json", "/livez", "/readyz", "/metrics"};
  forEachOperation(openApi(), [&](const std::string& path, const std::string& method, const Json& operation) {
    EXPECT_EQ(operation["responses"].contains("400"), !readNone.contains(path)) << method << " " << path;
  });
}

TEST(OpenApi, AFrameIsGivenInEveryForm) {
  const Json document = openApi();
  std::set<std::string> all{"multipart/mixed", "application/json"};
  for (const FormatTraits& format : kFormatTraits) all.emplace(format.mediaType);
  for (const char* route : {"/v1/scenes/{id}/frames", "/v1/render"}) {
    const Json& reply = document["paths"][route]["post"]["responses"]["200"];
    std::set<std::string> forms;
    for (const auto& [form, schema] : reply["content"].items()) forms.insert(form);
    EXPECT_EQ(forms, all);
    EXPECT_TRUE(reply["headers"].contains("Repr-Digest"));
  }
}

TEST(OpenApi, QueryParametersAreOnesThatTheDecoderKnows) {
  const Json document = openApi();
  const Json& parameters = document["paths"]["/v1/scenes/{id}/frame"]["get"]["parameters"];
  std::set<std::string> names;
  for (const Json& parameter : parameters) {
    if (parameter.value("in", "") != "query") continue;
    const std::string name = parameter["name"];
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_FALSE(parameter["description"].get<std::string>().empty()) << name;
    // A value of a type that no field takes: the decoder complains about the value, not about the key.
    const Result<FrameSpec> spec = decodeFrameQuery({{name, "{\"?\":0}"}});
    ASSERT_FALSE(spec) << name;
    // Fields that go with it may be missed besides.
    const std::string object = name.substr(0, name.rfind('.') + 1);
    EXPECT_EQ(std::ranges::count(spec.problems(), name, &Problem::pointer), 1) << name;
    for (const Problem& problem : spec.problems()) {
      EXPECT_TRUE(problem.pointer == name || (!object.empty() && problem.pointer.starts_with(object))) << name;
      EXPECT_NE(problem.detail, "There is no field of this name.") << name;
    }
  }
  for (const char* name : {"sun", "view", "format", "width", "camera.orbit.azimuthDegrees", "shadow.filter.size"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(OpenApi, RefusalsAreProblems) {
  const Json document = openApi();
  for (const auto& [status, response] : document["components"]["responses"].items()) {
    if (status == "304") continue;
    EXPECT_EQ(response["content"]["application/problem+json"]["schema"]["$ref"], "#/components/schemas/Problem");
  }
}

} // namespace
} // namespace gnomon
