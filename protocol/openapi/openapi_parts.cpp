#include "protocol/openapi/openapi_parts.h"

#include <nlohmann/json.hpp>

namespace gnomon::openapi {

Json reference(const std::string& place) {
  return {{"$ref", "#/components/" + place}};
}

Json schemaContent(const std::string& schema) {
  return {{"schema", reference("schemas/" + schema)}};
}

Json bytesContent() {
  return Json::object();
}

Json success(const char* description, Json content, std::initializer_list<const char*> headers) {
  Json response = {{"description", description}, {"headers", Json::object()}};
  response["headers"]["X-Request-ID"] = reference("headers/X-Request-ID");
  for (const char* header : headers) response["headers"][header] = reference(std::string("headers/") + header);
  if (!content.empty()) response["content"] = std::move(content);
  return response;
}

Json replies(Json good, std::initializer_list<const char*> statuses) {
  for (const char* status : statuses) good[status] = reference(std::string("responses/") + status);
  return good;
}

Json operation(const char* id, const char* summary, Json responses) {
  return {{"operationId", id}, {"summary", summary}, {"responses", std::move(responses)}};
}

Json withScene(Json operation) {
  operation["parameters"] = Json::array({reference("parameters/sceneId")});
  return operation;
}

Json withBody(Json operation, Json body) {
  operation["requestBody"] = std::move(body);
  return operation;
}

} // namespace gnomon::openapi
