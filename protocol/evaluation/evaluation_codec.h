#pragma once

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"

/// How JSON that is kept as it is passes through the rows.
namespace gnomon {

/// The same value; of a key that comes twice the last.
Json jsonOf(const JsonNode& node);
JsonNode nodeOf(const Json& json);

bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems, SpecPatch& out);
Json encodeValue(const SpecPatch& patch);

// What only replies hold.
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::uint64_t& out);
bool decodeValue(const JsonNode& node, const Notes& notes, const Place& place, ProblemList& problems,
                 std::vector<StageTime>& out);

} // namespace gnomon
