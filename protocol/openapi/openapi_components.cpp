#include "protocol/fields/json_schema.h"
#include "protocol/json/problem_json.h"
#include "protocol/openapi/openapi.h"
#include "protocol/report/reply_rows.h"

namespace gnomon {
namespace {

struct Refusal {
  const char* status;
  const char* description;
};

/// What a status means wherever it is given.
constexpr std::array kRefusals{
    Refusal{"400", "The request is malformed, or a value in it cannot be taken."},
    Refusal{"404", "There is no such scene or route."},
    Refusal{"406", "None of the accepted forms can be given."},
    Refusal{"408", "The request came too slowly."},
    Refusal{"411", "The body needs a Content-Length."},
    Refusal{"413", "A limit on bytes, pixels, triangles or nodes was passed."},
    Refusal{"415", "The route takes no body of that type."},
    Refusal{"422", "The scene breaks the rules of glTF, needs what Gnomon does not have, or is not the one named."},
    Refusal{"429", "The server has enough to do; Retry-After says when to come again."},
    Refusal{"500", "The server made a mistake, or its graphics context failed."},
    Refusal{"503", "The server is starting or shutting down."},
    Refusal{"504", "The work was not finished in its time."},
};

Json header(const char* description) {
  return {{"description", description}, {"schema", {{"type", "string"}}}};
}

Json headers() {
  return {{"ETag", header("Changes whenever the picture could; If-None-Match with it is answered by 304.")},
          {"Server-Timing", header("Milliseconds of each stage: queue, load, upload, survey, plan, shadow, shade, "
                                   "readback, encode.")},
          {"X-Request-ID", header("The client's, if it sent a well-formed one, or a new one.")},
          {"Retry-After", header("Seconds.")},
          {"Location", header("Where the scene is.")}};
}

Json parameters() {
  return {{"sceneId",
           {{"name", "id"},
            {"in", "path"},
            {"required", true},
            {"description", "SHA-256 of the upload, as 64 lower-case hexadecimal digits."},
            {"schema", {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}}}}},
          {"ifNoneMatch",
           {{"name", "If-None-Match"},
            {"in", "header"},
            {"description", "The ETag of a picture that the client has."},
            {"schema", {{"type", "string"}}}}}};
}

Json responses() {
  Json result = Json::object();
  for (const Refusal& refusal : kRefusals) {
    Json response = {
        {"description", refusal.description},
        {"headers", {{"X-Request-ID", {{"$ref", "#/components/headers/X-Request-ID"}}}}},
        {"content", {{"application/problem+json", {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}};
    if (std::string_view(refusal.status) == "429") {
      response["headers"]["Retry-After"] = {{"$ref", "#/components/headers/Retry-After"}};
    }
    result[refusal.status] = std::move(response);
  }
  result["304"] = {{"description", "The client has this picture already."},
                   {"headers", {{"ETag", {{"$ref", "#/components/headers/ETag"}}}}}};
  return result;
}

Json schemas() {
  Json components = Json::object();
  schemaOf<FrameSpec>(Notes{}, components);
  schemaOf<FrameReply>(Notes{}, components);
  schemaOf<PlanReport>(Notes{}, components);
  schemaOf<SceneList>(Notes{}, components);
  schemaOf<Capabilities>(Notes{}, components);
  addEvaluationSchemas(components);
  components["Problem"] = problemSchema();
  return components;
}

} // namespace

Json openApiComponents() {
  return {{"schemas", schemas()}, {"responses", responses()}, {"headers", headers()}, {"parameters", parameters()}};
}

} // namespace gnomon
