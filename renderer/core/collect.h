#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>

#include "protocol/base/result.h"

/// Problems of several checks gathered in one list.
namespace gnomon {

/// Adds those that are not there yet.
inline void collect(const Problems& more, ProblemList& problems) {
  const auto parts = [](const Problem& each) {
    return std::tie(each.code, each.pointer, each.detail, each.limit, each.actual);
  };
  for (const Problem& problem : more) {
    const auto isSame = [&](const Problem& other) { return parts(other) == parts(problem); };
    if (std::ranges::none_of(problems.problems(), isSame)) problems.add(problem);
  }
}

/// The value of a result; where there is none, nothing, and its problems are added.
template <class T>
std::optional<T> collect(Result<T> result, ProblemList& problems) {
  if (result) return *std::move(result);
  collect(result.problems(), problems);
  return std::nullopt;
}

/// Problems with places in one part of a whole, seen from the whole. `pointer`: of the part.
inline Problems placedAt(std::string_view pointer, Problems problems) {
  for (Problem& problem : problems) problem.pointer.insert(0, pointer);
  return problems;
}

} // namespace gnomon
