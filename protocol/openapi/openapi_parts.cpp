#include "protocol/openapi/openapi_parts.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "protocol/bake/bake.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/json_schema.h"
#include "protocol/job/job.h"
#include "protocol/json/json_codec.h"
#include "protocol/report/replies.h"
#include "protocol/sequence/sequence.h"

namespace gnomon::openapi {
namespace {

struct Refusal {
  const char* status;
  const char* description;
};

/// What a status means wherever it is given.
constexpr std::array kRefusals{
    Refusal{"400", "The request is malformed, or one of its values is invalid."},
    Refusal{"401", "No key came with the request, or none that the server knows."},
    Refusal{"403", "The key or the signature does not allow this request, or a page of another server sent it."},
    Refusal{"404", "No such scene or route exists."},
    Refusal{"406", "The resource has none of the media types that Accept lists."},
    Refusal{"408", "The request arrived too slowly."},
    Refusal{"411", "The request needs a body with a Content-Length."},
    Refusal{"412", "The resource has none of the entity tags that If-Match lists."},
    Refusal{"413", "A limit on bytes, pixels, triangles or nodes is exceeded."},
    Refusal{"415", "The route does not accept this Content-Type."},
    Refusal{"421", "The server is not known by the name in Host."},
    Refusal{"422", "The scene is not valid glTF, needs a feature that Gnomon does not have, or does not match the id."},
    Refusal{"429", "The server is busy, or the key has used up its share; Retry-After says when to try again."},
    Refusal{"500", "An internal error, or a failure of the graphics context."},
    Refusal{"503",
            "The server is starting or shutting down, or what keeps its scenes and jobs is away; Retry-After says "
            "when to try again."},
    Refusal{"504", "The request's deadline passed before its work was done."},
    Refusal{"507", "The scene store is full, or jobs have as much as they may."},
};

Json header(const char* description) {
  return {{"description", description}, {"schema", {{"type", "string"}}}};
}

Json headers() {
  return {
      {"ETag", header("Changes whenever the picture could; If-None-Match with it is answered by 304.")},
      {"Repr-Digest", header("sha-256=:BASE64: of the body (RFC 9530).")},
      {"Server-Timing", header("Milliseconds of each stage: queue, load, upload, survey, plan, shadow, shade, "
                               "readback, encode.")},
      {"X-Request-ID", header("The client's, if it sent a well-formed one, or a new one.")},
      {"traceresponse", header("00-TRACE-SPAN-FLAGS: the request's place in the trace of its traceparent, or in a new "
                               "one.")},
      {"Retry-After", header("Seconds.")},
      {"WWW-Authenticate", header("Bearer: that a key is asked for.")},
      {"Location", header("Where the scene, or the job, is.")},
      {"Preference-Applied", header("respond-async (RFC 7240).")},
      {"Link", header("The next page, where there is one, as rel=next (RFC 8288).")}};
}

Json parameters() {
  return {{"sceneId", parameter("id", "path", "SHA-256 of the upload, as 64 lower-case hexadecimal digits.",
                                {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}})},
          {"jobId", parameter("id", "path", "The job's id, from the reply that made it.",
                              {{"type", "string"}, {"pattern", "^[0-9a-f]{32}$"}})},
          {"bakeKey", parameter("key", "path", "The bake's key, from its report or its progress.",
                                {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}})},
          {"ifMatch", parameter("If-Match", "header", "The ETag that the picture has to have.", {{"type", "string"}})},
          {"ifNoneMatch",
           parameter("If-None-Match", "header", "The ETag of a picture that the client has.", {{"type", "string"}})}};
}

Json responses() {
  Json result = Json::object();
  for (const Refusal& refusal : kRefusals) {
    Json response = {
        {"description", refusal.description},
        {"headers",
         {{"X-Request-ID", reference("headers/X-Request-ID")}, {"traceresponse", reference("headers/traceresponse")}}},
        {"content", {{"application/problem+json", {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}};
    if (std::string_view(refusal.status) == "401") {
      response["headers"]["WWW-Authenticate"] = {{"$ref", "#/components/headers/WWW-Authenticate"}};
    }
    if (std::string_view(refusal.status) == "429" || std::string_view(refusal.status) == "503") {
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
  schemaOf<NodeList>(Notes{}, components);
  schemaOf<Capabilities>(Notes{}, components);
  schemaOf<EvaluationRequest>(Notes{}, components);
  schemaOf<EvaluationReport>(Notes{}, components);
  schemaOf<EvaluationStep>(Notes{}, components);
  schemaOf<SequenceRequest>(Notes{}, components);
  schemaOf<SequenceFrame>(Notes{}, components);
  schemaOf<SequenceReport>(Notes{}, components);
  schemaOf<Job>(Notes{}, components);
  schemaOf<JobList>(Notes{}, components);
  schemaOf<BakeReport>(Notes{}, components);
  schemaOf<BakeStep>(Notes{}, components);
  components["Problem"] = problemSchema();
  return components;
}

} // namespace

Json reference(const std::string& place) {
  return {{"$ref", "#/components/" + place}};
}

Json schemaContent(const std::string& schema) {
  return {{"schema", reference("schemas/" + schema)}};
}

Json bytesContent() {
  return Json::object();
}

Json parameter(const char* name, const char* in, const char* description, Json schema) {
  Json result = {{"name", name}, {"in", in}};
  if (std::string_view(in) == "path") result["required"] = true;
  result["description"] = description;
  result["schema"] = std::move(schema);
  return result;
}

Json success(const char* description, Json content, std::initializer_list<const char*> headers) {
  Json response = {{"description", description}, {"headers", Json::object()}};
  response["headers"]["X-Request-ID"] = reference("headers/X-Request-ID");
  response["headers"]["traceresponse"] = reference("headers/traceresponse");
  for (const char* header : headers) response["headers"][header] = reference(std::string("headers/") + header);
  if (!content.empty()) response["content"] = std::move(content);
  return response;
}

Json replies(Json good, std::initializer_list<const char*> statuses) {
  for (const char* status : statuses) good[status] = reference(std::string("responses/") + status);
  return good;
}

Json jsonReply(const char* description, const char* schema) {
  return {{"200", success(description, {{"application/json", schemaContent(schema)}})}};
}

Json operation(const char* id, const char* summary, Json responses) {
  return {{"operationId", id}, {"summary", summary}, {"responses", std::move(responses)}};
}

Json getRoute(const char* id, const char* summary, Json responses) {
  return {{"get", operation(id, summary, std::move(responses))}};
}

Json withScene(Json operation) {
  operation["parameters"] = Json::array({reference("parameters/sceneId")});
  return operation;
}

Json withBake(Json operation) {
  operation["parameters"] = Json::array({reference("parameters/sceneId"), reference("parameters/bakeKey")});
  return operation;
}

Json withJob(Json operation) {
  operation["parameters"] = Json::array({reference("parameters/jobId")});
  return operation;
}

Json withBody(Json operation, Json body) {
  operation["requestBody"] = std::move(body);
  return operation;
}

Json components() {
  return {{"schemas", schemas()},
          {"responses", responses()},
          {"headers", headers()},
          {"parameters", parameters()},
          {"securitySchemes", securitySchemes()}};
}

} // namespace gnomon::openapi
