#pragma once

#include <string>
#include <utility>

#include "protocol/base/result.h"

namespace gnomon::gl {

inline Problem backendProblem(std::string detail) {
  Problem problem;
  problem.code = ProblemCode::backend;
  problem.detail = std::move(detail);
  return problem;
}

} // namespace gnomon::gl
