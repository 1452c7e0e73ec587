#include "server/http/problem_reply.h"

#include <nlohmann/json.hpp>

#include "protocol/json/problem_json.h"

namespace gnomon {

int statusOf(ProblemCode code) {
  switch (code) {
    case ProblemCode::malformed:
    case ProblemCode::invalidValue:
      return 400;
    case ProblemCode::notFound:
      return 404;
    case ProblemCode::methodNotAllowed:
      return 405;
    case ProblemCode::notAcceptable:
      return 406;
    case ProblemCode::lengthRequired:
      return 411;
    case ProblemCode::tooLarge:
      return 413;
    case ProblemCode::unsupportedMediaType:
      return 415;
    case ProblemCode::invalidScene:
    case ProblemCode::unsupportedFeature:
    case ProblemCode::hashMismatch:
      return 422;
    case ProblemCode::busy:
      return 429;
    case ProblemCode::unavailable:
      return 503;
    case ProblemCode::deadlineExceeded:
      return 504;
    case ProblemCode::backend:
    case ProblemCode::internal:
      return 500;
  }
  return 500;
}

HttpReply problemReply(const Problems& problems, std::string_view instance) {
  return problemReply(problems, instance, statusOf(problems.front().code));
}

HttpReply problemReply(const Problems& problems, std::string_view instance, int status) {
  HttpReply reply;
  reply.status = status;
  reply.contentType = "application/problem+json";
  reply.body = problemJson(problems, status, instance).dump();
  reply.headers.emplace_back("Cache-Control", "no-store");
  reply.note = problems.front().detail;
  return reply;
}

HttpReply busyReply(const Problems& problems, std::string_view instance, int retryAfterSeconds) {
  HttpReply reply = problemReply(problems, instance);
  reply.headers.emplace_back("Retry-After", std::to_string(retryAfterSeconds));
  return reply;
}

} // namespace gnomon
