#pragma once

#include <gmock/gmock.h>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// The pointers of a result's problems in order; none where there is a value.
template <class T>
std::vector<std::string> pointersOf(const Result<T>& result) {
  std::vector<std::string> pointers;
  if (!result) {
    for (const Problem& problem : result.problems()) pointers.push_back(problem.pointer);
  }
  return pointers;
}

inline std::vector<std::string> pointersOf(const Problems& problems) {
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.pointer);
  return pointers;
}

} // namespace gnomon
