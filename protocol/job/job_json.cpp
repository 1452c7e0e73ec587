#include "protocol/job/job_json.h"

#include <nlohmann/json.hpp>

#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"

namespace gnomon {

Json toJson(const Job& job) {
  return encodeValue(job);
}
Json toJson(const JobList& list) {
  return encodeValue(list);
}

std::optional<Job> readJob(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object() || !document.contains("id") || !document.contains("state")) return std::nullopt;
  Job job;
  ProblemList unknown;
  decodeValue(nodeOf(document), Notes{}, Place(), unknown, job);
  return job;
}

std::optional<JobList> readJobList(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object() || !document.contains("jobs")) return std::nullopt;
  JobList list;
  ProblemList unknown;
  decodeValue(nodeOf(document), Notes{}, Place(), unknown, list);
  return list;
}

} // namespace gnomon
