// Frame specs and evaluations as JSON. What is taken is written again, and read back the same.
#include <nlohmann/json.hpp>

#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"
#include "tests/fuzz/sound_problems.h"

namespace {

using namespace gnomon;

void requireTold(const Problems& problems) {
  fuzz::requireSound(problems);
  fuzz::require(!problemJson(problems, 400, "").dump().empty(), "problems can be written");
}

void readSpec(std::string_view text) {
  const auto spec = decodeFrameSpec(text);
  if (!spec) return requireTold(spec.problems());
  const std::string written = toJson(*spec).dump();
  const auto again = decodeFrameSpec(written);
  fuzz::require(static_cast<bool>(again), "a spec that was written can be read");
  fuzz::require(toJson(*again).dump() == written, "it is read as it was written");
}

void readEvaluation(std::string_view text) {
  const auto evaluation = decodeEvaluation(text);
  if (!evaluation) requireTold(evaluation.problems());
  if (const auto report = readEvaluationReport(text)) (void)toJson(*report).dump();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  readSpec(text);
  readEvaluation(text);
  return 0;
}
