#pragma once

#include <initializer_list>
#include <string>

#include "protocol/base/json.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/json_source.h"

/// What the routes' descriptions are put together from.
namespace gnomon::openapi {

Json reference(const std::string& place); ///< to a component: "schemas/FrameSpec"
Json schemaContent(const std::string& schema);
Json bytesContent(); ///< bytes of a media type have no schema of their own in OpenAPI 3.1

Json success(const char* description, Json content, std::initializer_list<const char*> headers = {});

/// Of a query, a header or a path; in a path it is required.
Json parameter(const char* name, const char* in, const char* description, Json schema);

/// A route's replies: `good`, and the refusals of these statuses.
Json replies(Json good, std::initializer_list<const char*> statuses);

/// A reply of 200 with JSON of a schema.
Json jsonReply(const char* description, const char* schema);

Json operation(const char* id, const char* summary, Json responses);
Json getRoute(const char* id, const char* summary, Json responses); ///< of GET alone
Json withScene(Json operation);                                     ///< of a route with {id}
Json withBake(Json operation);                                      ///< of a route with {id} and {key}
Json withJob(Json operation);                                       ///< of a route with the {id} of a job
Json withBody(Json operation, Json body);

/// The schemas, responses, headers and parameters that the routes refer to.
Json components();

/// The two kinds of credentials: components/securitySchemes.
Json securitySchemes();

/// The paths with what each operation needs where the server has keys, and with the replies that refuse a request
/// because of the client's key or address.
Json withAccess(Json paths);

Json sequencesRoute(); ///< /v1/scenes/{id}/sequences
Json jobsRoute();      ///< /v1/jobs
Json jobRoute();       ///< /v1/jobs/{id}
Json jobResultRoute(); ///< /v1/jobs/{id}/result
Json jobFrameRoute();  ///< /v1/jobs/{id}/frames/{index}

} // namespace gnomon::openapi
