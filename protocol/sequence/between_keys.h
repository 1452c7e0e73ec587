#pragma once

#include <nlohmann/json.hpp>

#include "protocol/base/json.h"
#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

/// A frame's spec between two others, all as JSON: numbers and times interpolated linearly, all else that of `a`. `t`
/// 0..1; 0 gives exactly `a`, 1 exactly `b`. REQUIRES: checkNeighbours(a, b) found nothing.
Json between(const Json& a, const Json& b, double t);

/// Adds a problem for everything that two keys differ in and that can't be interpolated: texts but for times, words,
/// switches, whole numbers, lists of unequal length, and what only one of them has. `place`: of `b`.
void checkNeighbours(const Json& a, const Json& b, const Place& place, ProblemList& problems);

} // namespace gnomon
