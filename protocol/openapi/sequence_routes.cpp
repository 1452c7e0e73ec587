#include <nlohmann/json.hpp>
#include <string>

#include "protocol/openapi/openapi_parts.h"
#include "protocol/spec/traits.h"

namespace gnomon::openapi {
namespace {

Json sequenceForms() {
  const Json events = {{"anyOf", {reference("schemas/SequenceFrame"), reference("schemas/SequenceReport")}}};
  return {{"multipart/mixed", bytesContent()},
          {"application/zip", bytesContent()},
          {"text/event-stream", {{"schema", events}}}};
}

} // namespace

Json sequencesRoute() {
  const char* description =
      "Frames in order, sent as they are drawn, and at last a SequenceReport. multipart/mixed = a part for each "
      "picture "
      "(frame-00012.png), with the headers Gnomon-Frame, Gnomon-View and Gnomon-Carried (what the next frame needs, if "
      "the sequence goes on there), and last report.json, or problem.json; application/zip = the same files; "
      "text/event-stream = an event `frame` (SequenceFrame) for each, and at last `result` (SequenceReport) or "
      "`problem` (Problem); video/webm = the first view of every frame as VP9, and last the report as a tag "
      "GNOMON_REPORT, or the problem as GNOMON_PROBLEM. Closing the connection ends the sequence.";
  Json forms = sequenceForms();
  forms["video/webm"] = bytesContent();
  Json post =
      operation("renderSequence", "Render many frames in order",
                replies({{"200", success(description, std::move(forms))},
                         {"202", success("A job that draws them.", {{"application/json", schemaContent("Job")}},
                                         {"Location", "Preference-Applied"})}},
                        {"400", "404", "406", "408", "411", "413", "415", "422", "429", "500", "503", "504", "507"}));
  const Json body = {{"required", true}, {"content", {{"application/json", schemaContent("SequenceRequest")}}}};
  post = withBody(withScene(std::move(post)), body);
  post["parameters"].push_back(
      parameter("Prefer", "header",
                "respond-async (RFC 7240): a job draws the frames, and the reply says where it is; no video is a job.",
                {{"type", "string"}}));
  return {{"post", std::move(post)}};
}

Json jobsRoute() {
  return getRoute("listJobs", "The jobs of the client's key, the newest first",
                  replies(jsonReply("All of them.", "JobList"), {"400", "503"}));
}

Json jobRoute() {
  const char* description =
      "What it is doing. text/event-stream = an event `progress` (Job) for all that happens to it, and at last "
      "`result` "
      "(Job), whatever became of it.";
  const Json content = {{"application/json", schemaContent("Job")},
                        {"text/event-stream", {{"schema", reference("schemas/Job")}}}};
  Json get = withJob(operation("getJob", "How far a job is",
                               replies({{"200", success(description, content)}}, {"400", "404", "406", "503"})));
  get["parameters"].push_back(
      parameter("wait", "query", "Seconds to wait for its end, at most --request-timeout; Prefer: wait= does the same.",
                {{"type", "integer"}, {"minimum", 0}}));
  Json remove = operation("deleteJob", "End a job and remove its pictures",
                          replies({{"204", success("It is gone.", Json())}}, {"400", "404", "503"}));
  return {{"get", std::move(get)}, {"delete", withJob(std::move(remove))}};
}

Json jobResultRoute() {
  const char* description =
      "All frames in order, in the forms of a sequence; those that are not drawn yet are sent when they are.";
  Json get = operation("getJobResult", "The pictures of a job",
                       replies({{"200", success(description, sequenceForms())}},
                               {"400", "404", "406", "413", "422", "429", "500", "503", "504", "507"}));
  return {{"get", withJob(std::move(get))}};
}

Json jobFrameRoute() {
  Json content = {{"multipart/mixed", bytesContent()}};
  for (const FormatTraits& format : kFormatTraits) content[std::string(format.mediaType)] = bytesContent();
  Json get =
      withJob(operation("getJobFrame", "A frame of a job",
                        replies({{"200", success("Its picture; of several views multipart/mixed.", content, {"ETag"})}},
                                {"304", "400", "404", "406", "412", "503"})));
  get["parameters"].push_back(parameter("index", "path", "Index of the frame.", {{"type", "integer"}, {"minimum", 0}}));
  for (const char* name : {"parameters/ifMatch", "parameters/ifNoneMatch"})
    get["parameters"].push_back(reference(name));
  return {{"get", std::move(get)}};
}

} // namespace gnomon::openapi
