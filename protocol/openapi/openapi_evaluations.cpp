#include <nlohmann/json.hpp>

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/json_schema.h"
#include "protocol/openapi/openapi.h"
#include "protocol/openapi/openapi_parts.h"

namespace gnomon {

Json evaluationsRoute() {
  using namespace openapi;
  const char* description =
      "One row a variant: its speed and its error. text/csv = the rows as a table; image/svg+xml = a chart with the "
      "Pareto front; text/event-stream = events while it lasts: `progress` (EvaluationStep), `row` (an EvaluationRow "
      "whose errors are known and whose times are not), and at last `result` (EvaluationReport) or `problem` "
      "(Problem). "
      "Whoever closes the connection ends the evaluation.";
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

void addEvaluationSchemas(Json& components) {
  schemaOf<EvaluationRequest>(Notes{}, components);
  schemaOf<EvaluationReport>(Notes{}, components);
  schemaOf<EvaluationStep>(Notes{}, components);
}

} // namespace gnomon
