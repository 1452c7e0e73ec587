#pragma once

#include "protocol/json/json_codec.h"

namespace gnomon {

/// The OpenAPI 3.1 document of every route. The schemas of requests and replies are computed from the field rows.
Json openApi();

/// The document's components: schemas, responses, headers and parameters that the routes refer to.
Json openApiComponents();

/// The path item of evaluations, and the schemas that it refers to.
Json evaluationsRoute();
void addEvaluationSchemas(Json& components);

} // namespace gnomon
