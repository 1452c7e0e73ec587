#include "protocol/openapi/openapi.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "protocol/fields/field_list.h"
#include "protocol/openapi/openapi_parts.h"
#include "protocol/report/replies.h"
#include "protocol/spec/debug_light.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

using namespace openapi;

Json textPart(const char* description) {
  return {{"type", "string"}, {"description", description}};
}

constexpr const char* kStrict = "Refuse a model that violates glTF, with all of its problems, instead of repairing it.";

/// The parts of an upload: the model, and the files that it names under their own file names.
Json uploadParts() {
  const Json files = {{"type", "array"},
                      {"items", {{"type", "string"}}},
                      {"description", "A file that the model names, with its name as the part's file name."}};
  const Json strict = {{"type", "string"}, {"enum", {"true", "false"}}, {"description", kStrict}};
  return {{"scene", textPart("The model, glTF or GLB.")}, {"file", files}, {"strict", strict}};
}

Json strictParameter() {
  return parameter("strict", "query", kStrict, {{"type", "boolean"}, {"default", false}});
}

/// A scene as the whole body, or as a form with the files that it names.
Json sceneBody() {
  const Json form = {{"schema",
                      {{"type", "object"},
                       {"description", "The model and every file that it names."},
                       {"required", {"scene"}},
                       {"properties", uploadParts()},
                       {"additionalProperties", textPart("A file that the model names, under its name.")}}}};
  return {
      {"required", true},
      {"content",
       {{"model/gltf-binary", bytesContent()}, {"model/gltf+json", bytesContent()}, {"multipart/form-data", form}}}};
}

Json specBody() {
  return {{"description", "Absent or {} = every default."},
          {"required", false},
          {"content", {{"application/json", schemaContent("FrameSpec")}}}};
}

Json renderBody() {
  Json parts = uploadParts();
  parts["spec"] = reference("schemas/FrameSpec");
  const Json form = {{"schema",
                      {{"type", "object"},
                       {"description", "The model, every file that it names, and what to show of it."},
                       {"required", {"scene"}},
                       {"properties", parts},
                       {"additionalProperties", textPart("A file that the model names, under its name.")}}},
                     {"encoding", {{"spec", {{"contentType", "application/json"}}}}}};
  return {{"required", true}, {"content", {{"multipart/form-data", form}}}};
}

/// A frame in the form that Accept asks for.
Json frameReplies(std::initializer_list<const char*> statuses) {
  Json content = {{"multipart/mixed", bytesContent()}, {"application/json", schemaContent("FrameReply")}};
  for (const FormatTraits& format : kFormatTraits) content[std::string(format.mediaType)] = bytesContent();
  const char* description =
      "The frame: image/png, image/jpeg, image/webp, image/tiff and application/x-npy = the first view; image/x-exr = "
      "every view as named layers; application/zip = every view as an array for NumPy, and the report; multipart/mixed "
      "= every picture and the report; application/json = the report with the pictures in base64.";
  return replies({{"200", success(description, content, {"ETag", "Repr-Digest", "Server-Timing"})}}, statuses);
}

Json sceneReplies(std::initializer_list<const char*> statuses) {
  const Json content = {{"application/json", schemaContent("SceneSummary")}};
  return replies({{"200", success("The scene was known already.", content, {"Location"})},
                  {"201", success("The scene is new.", content, {"Location"})}},
                 statuses);
}

/// A query key for each field outside of lists, and the short forms.
Json queryParameters() {
  Json parameters = Json::array(
      {reference("parameters/sceneId"), reference("parameters/ifMatch"), reference("parameters/ifNoneMatch")});
  const auto add = [&](const std::string& name, const std::string& description, Json schema) {
    Json parameter = {{"name", name}, {"in", "query"}, {"description", description}};
    schema.erase("description");
    const bool isText = !schema.contains("type") || schema["type"] != "array";
    if (isText) {
      parameter["schema"] = std::move(schema);
    } else {
      parameter["content"] = {{"application/json", {{"schema", std::move(schema)}}}};
    }
    parameters.push_back(std::move(parameter));
  };
  add("sun", "AZIMUTH,ELEVATION in degrees, or LATITUDE,LONGITUDE TIME: one directional light; short for lights.",
      {{"type", "string"}, {"pattern", "^[^,]+,[^,]+$"}, {"examples", {"135,40"}}});
  add("lights", "The lights.", {{"type", "array"}, {"items", reference("schemas/Light")}});
  for (const FieldEntry& field : frameFields()) {
    if (field.path.find("[]") != std::string::npos) continue;
    if (field.path == "views") add("view", "The one view to show; short for views.", field.schema["items"]);
    if (field.path == "output.format") add("format", "Short for output.format.", field.schema);
    add(field.path, field.schema.value("description", field.says), field.schema);
  }
  return parameters;
}

Json sceneRoute() {
  Json put = operation("putScene", "Upload a scene by name",
                       sceneReplies({"400", "408", "411", "413", "415", "422", "429", "500", "503", "504", "507"}));
  put = withScene(std::move(put));
  put["parameters"].push_back(strictParameter());
  // Where no summary is kept, a worker loads the scene for it, whatever the method.
  const auto summary = [](Json good) {
    return replies(std::move(good), {"400", "404", "413", "422", "429", "500", "503", "504"});
  };
  Json get = operation("getScene", "What a scene holds", summary(jsonReply("Its summary.", "SceneSummary")));
  Json head = operation("headScene", "Whether a scene is there", summary({{"200", success("It is there.", Json())}}));
  Json remove = operation("deleteScene", "Remove a scene",
                          replies({{"204", success("It is gone.", Json())}}, {"400", "404", "503"}));
  return {{"put", withBody(std::move(put), sceneBody())},
          {"get", withScene(std::move(get))},
          {"head", withScene(std::move(head))},
          {"delete", withScene(std::move(remove))}};
}

Json scenesRoute() {
  Json post = operation("postScene", "Upload a scene; its name is the hash of its bytes",
                        sceneReplies({"400", "408", "411", "413", "415", "422", "429", "500", "503", "504", "507"}));
  post["parameters"] = Json::array({strictParameter()});
  const Json content = {{"application/json", schemaContent("SceneList")}};
  Json get = operation(
      "listScenes", "The scenes that there are, in pages",
      replies({{"200", success("A page, ascending by id; it may have fewer than `limit`.", content, {"Link"})}},
              {"400", "429", "500", "503", "504"}));
  get["parameters"] =
      Json::array({parameter("limit", "query", "The most scenes on the page.",
                             {{"type", "integer"}, {"minimum", 1}, {"maximum", 1000}, {"default", 100}}),
                   parameter("after", "query", "What the page before gave as its `next`; absent = the first page.",
                             {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}})});
  return {{"get", std::move(get)}, {"post", withBody(std::move(post), sceneBody())}};
}

Json nodesRoute() {
  Json get =
      withScene(operation("listNodes", "The nodes of a scene's file, in pages",
                          replies(jsonReply("A page, ascending by index; it may have fewer than `limit`.", "NodeList"),
                                  {"400", "404", "422", "429", "500", "503", "504"})));
  get["parameters"].push_back(
      parameter("limit", "query", "The most nodes on the page.",
                {{"type", "integer"}, {"minimum", 1}, {"maximum", kMostNodesOnPage}, {"default", NodePage{}.limit}}));
  get["parameters"].push_back(parameter("after", "query",
                                        "What the page before gave as its `next`; absent = the first page.",
                                        {{"type", "integer"}, {"minimum", 0}}));
  return {{"get", std::move(get)}};
}

Json framesRoute() {
  Json post = operation(
      "renderFrame", "Render a frame",
      frameReplies({"304", "400", "404", "406", "408", "411", "412", "413", "415", "422", "429", "500", "503", "504"}));
  post["parameters"] = Json::array(
      {reference("parameters/sceneId"), reference("parameters/ifMatch"), reference("parameters/ifNoneMatch")});
  return {{"post", withBody(std::move(post), specBody())}};
}

Json planRoute() {
  Json post = operation("planFrame", "Decide a frame without rendering it",
                        replies(jsonReply("What it would do.", "PlanReport"),
                                {"400", "404", "408", "411", "413", "415", "422", "429", "500", "503", "504"}));
  return {{"post", withBody(withScene(std::move(post)), specBody())}};
}

Json frameRoute() {
  Json get = operation("getFrame", "Render a frame from a query string, for links and <img>",
                       frameReplies({"304", "400", "404", "406", "412", "413", "422", "429", "500", "503", "504"}));
  get["description"] = "Keys are a field's path, as camera.node or lights[0].intensity; values are JSON or bare words.";
  get["parameters"] = queryParameters();
  return {{"get", std::move(get)}};
}

Json evaluationsRoute() {
  const char* description =
      "One row a variant: its speed and its error. text/csv = the rows as a table; image/svg+xml = a chart with the "
      "Pareto front; text/event-stream = events while it lasts: `progress` (EvaluationStep), `row` (an EvaluationRow "
      "whose errors are known and whose times are not), and at last `result` (EvaluationReport) or `problem` "
      "(Problem). "
      "Closing the connection ends the evaluation.";
  const Json content = {{"application/json", schemaContent("EvaluationReport")},
                        {"text/csv", bytesContent()},
                        {"image/svg+xml", bytesContent()},
                        {"text/event-stream", {{"schema", {{"anyOf", {reference("schemas/EvaluationStep")}}}}}}};
  Json post = operation("evaluate", "Measure speed against error",
                        replies({{"200", success(description, content)}},
                                {"400", "404", "406", "408", "411", "413", "415", "422", "429", "500", "503", "504"}));
  const Json body = {{"required", true}, {"content", {{"application/json", schemaContent("EvaluationRequest")}}}};
  return {{"post", withBody(withScene(std::move(post)), body)}};
}

Json bakesRoute() {
  const char* description =
      "Bakes the shadows of the lights whose technique is lightMap, so that frames of the same spec only look them up; "
      "where `environment.shadows` is rays, also what share of the environment's light arrives, for files of the bake. "
      "Of the body only what the shadows depend on matters; it may be the spec of such a frame. text/event-stream = "
      "events while it lasts: `progress` (BakeStep), and at last `result` (BakeReport) or `problem` (Problem). Closing "
      "the connection ends the bake.";
  const Json content = {{"application/json", schemaContent("BakeReport")},
                        {"text/event-stream", {{"schema", {{"anyOf", {reference("schemas/BakeStep")}}}}}}};
  Json post = operation("bake", "Bake light maps ahead of frames",
                        replies({{"200", success(description, content)}},
                                {"400", "404", "406", "408", "411", "413", "415", "422", "429", "500", "503", "504"}));
  return {{"post", withBody(withScene(std::move(post)), specBody())}};
}

Json bakeRoute() {
  Json remove =
      operation("deleteBake", "Stop or forget a bake",
                replies({{"204", success("It is gone; where it was in progress, it ends.", Json())}}, {"400", "404"}));
  const char* description =
      "image/png = the share of a light that arrives, in grey, or of the environment, in color; image/x-exr = the same "
      "in floats, a layer for each; "
      "model/gltf-binary = the scene with texture coordinates for the map and the light that arrives, under "
      "MOZ_lightmap.";
  const Json content = {
      {"image/png", bytesContent()}, {"image/x-exr", bytesContent()}, {"model/gltf-binary", bytesContent()}};
  Json get = withBake(operation("getBake", "What was baked, as a file",
                                replies({{"200", success(description, content)}},
                                        {"400", "404", "406", "413", "422", "429", "500", "503", "504"})));
  get["parameters"].push_back(parameter(
      "light", "query",
      "Index of one of the baked lights, or `environment`; without it the first for PNG, and all for EXR and GLB.",
      {{"anyOf",
        {Json{{"type", "integer"}, {"minimum", 0}}, Json{{"type", "string"}, {"enum", {kEnvironmentName}}}}}}));
  return {{"get", std::move(get)}, {"delete", withBake(std::move(remove))}};
}

Json renderRoute() {
  Json post = operation(
      "render", "Upload a scene and render a frame of it in one go",
      frameReplies({"304", "400", "406", "408", "411", "412", "413", "415", "422", "429", "500", "503", "504"}));
  post["parameters"] = Json::array({reference("parameters/ifNoneMatch"), strictParameter()});
  return {{"post", withBody(std::move(post), renderBody())}};
}

Json drakeRoute() {
  const Json number = {{"type", "number"}};
  Json fields = {{"scene", textPart("glTF whose buffers and images are data: URIs, with a node \"Camera Node\".")},
                 {"scene_sha256", textPart("SHA-256 of the part scene, in hexadecimal digits.")},
                 {"image_type", {{"type", "string"}, {"enum", {"color", "depth", "label"}}}},
                 {"submit", textPart("Sent by some clients; it means nothing.")}};
  for (const char* name : {"width", "height"}) fields[name] = {{"type", "integer"}, {"description", "Pixels."}};
  Json required = {"scene", "scene_sha256", "image_type", "width", "height"};
  for (const char* name : {"near", "far", "focal_x", "focal_y", "fov_x", "fov_y", "center_x", "center_y"}) {
    fields[name] = number;
    required.push_back(name);
  }
  for (const char* name : {"min_depth", "max_depth"}) {
    fields[name] = {{"type", "number"}, {"description", "Metres; needed with depth, and with nothing else."}};
  }
  const Json form = {
      {"schema",
       {{"type", "object"}, {"required", required}, {"properties", fields}, {"additionalProperties", false}}}};
  const char* description =
      "color: an RGB PNG; label: an RGB PNG of the materials' base colors; depth: a TIFF of 32-bit floats in metres, "
      "or "
      "a 16-bit PNG in millimetres.";
  Json good = {{"200", success(description, {{"image/png", bytesContent()}, {"image/tiff", bytesContent()}},
                               {"Repr-Digest", "Server-Timing"})}};
  Json post = operation(
      "renderDrake", "A picture for Drake's RenderEngineGltfClient",
      replies(std::move(good), {"400", "406", "408", "411", "413", "415", "422", "429", "500", "503", "504"}));
  post["description"] = "Refusals of the form and of the scene are text/plain, a line for each problem.";
  const Json body = {{"required", true}, {"content", {{"multipart/form-data", form}}}};
  return {{"post", withBody(std::move(post), body)}};
}

Json paths() {
  const Json document = {{"application/json", {{"schema", {{"type", "object"}}}}}};
  const Json probe = {{"200", success("Yes.", {{"text/plain", bytesContent()}})}};
  Json paths = Json::object();
  paths["/v1/scenes"] = scenesRoute();
  paths["/v1/scenes/{id}"] = sceneRoute();
  paths["/v1/scenes/{id}/nodes"] = nodesRoute();
  paths["/v1/scenes/{id}/frames"] = framesRoute();
  paths["/v1/scenes/{id}/frame"] = frameRoute();
  paths["/v1/scenes/{id}/plan"] = planRoute();
  paths["/v1/scenes/{id}/evaluations"] = evaluationsRoute();
  paths["/v1/scenes/{id}/sequences"] = sequencesRoute();
  paths["/v1/jobs"] = jobsRoute();
  paths["/v1/jobs/{id}"] = jobRoute();
  paths["/v1/jobs/{id}/result"] = jobResultRoute();
  paths["/v1/jobs/{id}/frames/{index}"] = jobFrameRoute();
  paths["/v1/scenes/{id}/bakes"] = bakesRoute();
  paths["/v1/scenes/{id}/bakes/{key}"] = bakeRoute();
  paths["/v1/render"] = renderRoute();
  paths["/render"] = drakeRoute();
  paths["/v1/capabilities"] =
      getRoute("capabilities", "What this server can do", jsonReply("Its renderer and limits.", "Capabilities"));
  paths["/openapi.json"] = getRoute("openApi", "This document", {{"200", success("OpenAPI 3.1.", document)}});
  paths["/livez"] = getRoute("live", "Whether the process lives", probe);
  paths["/readyz"] = getRoute("ready", "Whether frames can be asked for", replies(probe, {"503"}));
  Json metrics = getRoute("metrics", "What the server has done and is doing, in Prometheus' text format",
                          {{"200", success("All metrics.", {{"text/plain", bytesContent()}})}});
  metrics["get"]["description"] =
      "A server with an address for operators (--admin-port) serves it there alone, and answers 404 here.";
  paths["/metrics"] = std::move(metrics);
  paths["/"] =
      getRoute("page", "A page to try it all", {{"200", success("The page.", {{"text/html", bytesContent()}})}});
  return paths;
}

} // namespace

Json openApi() {
  return {{"openapi", "3.1.0"},
          {"info",
           {{"title", "Gnomon"},
            {"version", "1"},
            {"description",
             "A glTF scene, a camera and lights in; shadowed pictures out. glTF's conventions: "
             "right-handed, +Y up, metres. Angles are degrees. What is unknown, repeated, of the wrong "
             "type or out of range is refused with its place, never changed or passed over."},
            {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}}}},
          {"paths", withAccess(paths())},
          {"components", components()}};
}

} // namespace gnomon
