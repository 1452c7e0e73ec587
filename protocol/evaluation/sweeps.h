#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/evaluation/evaluation.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

/// A variant of a sweep.
struct SweepVariant {
  std::string name; ///< "pcf 5", "hard 4 x Large"
  Json patch;       ///< over the spec
};

/// The variants of a sweep over a spec in JSON (an object), each once. What they set goes for lights with a shadow of
/// their own as well, and takes away what would contradict it (a filter's radius, manual splits).
std::vector<SweepVariant> sweepVariants(Sweep sweep, const Json& spec);

/// A name for a variant from what it changes: "filter.type hard, cascadeCount 2". A patch of nothing is "as given".
std::string variantName(const Json& patch);

} // namespace gnomon
