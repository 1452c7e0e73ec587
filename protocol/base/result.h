#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon {

/// What kind of thing went wrong. The server derives the HTTP status from it, in one place.
enum class ProblemCode {
  malformed,            ///< the bytes are not what they claim to be (JSON, GLB, multipart)
  invalidValue,         ///< well formed, but a value is of the wrong type, out of range or contradicts another
  notFound,             ///< a scene, route, node or camera that does not exist
  methodNotAllowed,     ///< the route exists, the method does not
  unauthorized,         ///< no key came with the request, or one that is not known
  forbidden,            ///< a page of another origin, or a key, asks for what only others may
  misdirected,          ///< the server is asked under a name that is not its own
  notAcceptable,        ///< no view or format matches the Accept header
  preconditionFailed,   ///< what If-Match names is not what there is
  lengthRequired,       ///< a body without Content-Length where one is needed
  tooLarge,             ///< a limit on bytes, pixels, triangles or nodes was passed; or noMemory()
  unsupportedMediaType, ///< a Content-Type that the route does not take
  invalidScene,         ///< a glTF that breaks its own rules
  unsupportedFeature,   ///< a valid request or glTF that needs what Gnomon does not have
  hashMismatch,         ///< the uploaded bytes are not the ones that were named
  busy,                 ///< the render queue is full
  deadlineExceeded,     ///< the job waited or ran longer than it may
  unavailable,          ///< not ready, or shutting down
  insufficientStorage,  ///< the disk of the scene store is full
  backend,              ///< no graphics context, or the driver refused
  internal              ///< our own mistake
};

/// One problem, described so that the user can fix it.
struct Problem {
  ProblemCode code = ProblemCode::internal;
  std::string pointer{}; ///< where: a JSON pointer ("/camera/eye/0"), a query key, a part name; empty = the whole
  std::string detail{};  ///< one sentence for people; never a path of the server or an internal address
  std::string limit{};   ///< what would have been accepted, e.g. "1..16384"; empty = not about a limit
  std::string actual{};  ///< what came, shortened; empty = not about a value
};

inline Problem invalidValue(std::string pointer, std::string detail, std::string limit = {}, std::string actual = {}) {
  return {ProblemCode::invalidValue, std::move(pointer), std::move(detail), std::move(limit), std::move(actual)};
}

/// The system gave no memory for it. Such a problem names no limit; every other one of its code does.
inline Problem noMemory(std::string pointer, std::string detail) {
  return {ProblemCode::tooLarge, std::move(pointer), std::move(detail), {}, {}};
}

inline bool isNoMemory(const Problem& problem) {
  return problem.code == ProblemCode::tooLarge && problem.limit.empty();
}

using Problems = std::vector<Problem>;

/// The problems, or, where a list has none, one that says so: what fails always has a reason.
inline Problems atLeastOne(Problems problems) {
  if (problems.empty()) problems.push_back({.detail = "It failed without a reason."});
  return problems;
}

/// Collects what is wrong with an input, up to a bound, so that a hostile one can't grow the reply without end.
class ProblemList {
 public:
  static constexpr std::size_t kMax = 32;

  void add(Problem problem) {
    if (problems_.size() < kMax) {
      problems_.push_back(std::move(problem));
    } else {
      ++leftOut_;
    }
  }

  bool empty() const { return problems_.empty(); }
  const Problems& problems() const { return problems_; }

  /// Everything collected, and how many more there were.
  Problems take() && {
    if (leftOut_ > 0) {
      problems_.push_back(invalidValue("", "There are more problems than are listed here.", std::to_string(kMax),
                                       std::to_string(kMax + leftOut_)));
    }
    return std::move(problems_);
  }

 private:
  Problems problems_;
  std::size_t leftOut_ = 0;
};

/// A value, or the problems that prevented it: at least one, since a list without any becomes `internal`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Problem problem) : state_(Problems{std::move(problem)}) {}
  Result(Problems problems) : state_(atLeastOne(std::move(problems))) {}

  explicit operator bool() const { return state_.index() == 0; }

  T& operator*() & { return std::get<0>(state_); }
  const T& operator*() const& { return std::get<0>(state_); }
  T&& operator*() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }

  const Problems& problems() const& { return std::get<1>(state_); }
  Problems&& problems() && { return std::get<1>(std::move(state_)); }

 private:
  std::variant<T, Problems> state_;
};

/// The result of an action that gives nothing back.
struct Done {};
using Status = Result<Done>;

} // namespace gnomon
