#pragma once

#include <array>

#include "protocol/base/result.h"
#include "protocol/fields/fields.h"

/// The rows of problems; see fields.h.
namespace gnomon {

/// `says` is the title: the reason phrase of its HTTP status where the code has one to itself, else a name in that
/// form.
template <>
inline constexpr std::array kSpellings<ProblemCode>{
    spelling(ProblemCode::malformed, "malformed", "Malformed Request"),
    spelling(ProblemCode::invalidValue, "invalidValue", "Invalid Value"),
    spelling(ProblemCode::notFound, "notFound", "Not Found"),
    spelling(ProblemCode::methodNotAllowed, "methodNotAllowed", "Method Not Allowed"),
    spelling(ProblemCode::unauthorized, "unauthorized", "Unauthorized"),
    spelling(ProblemCode::forbidden, "forbidden", "Forbidden"),
    spelling(ProblemCode::misdirected, "misdirected", "Misdirected Request"),
    spelling(ProblemCode::notAcceptable, "notAcceptable", "Not Acceptable"),
    spelling(ProblemCode::lengthRequired, "lengthRequired", "Length Required"),
    spelling(ProblemCode::tooLarge, "tooLarge", "Content Too Large"),
    spelling(ProblemCode::unsupportedMediaType, "unsupportedMediaType", "Unsupported Media Type"),
    spelling(ProblemCode::invalidScene, "invalidScene", "Invalid Scene"),
    spelling(ProblemCode::unsupportedFeature, "unsupportedFeature", "Unsupported Feature"),
    spelling(ProblemCode::hashMismatch, "hashMismatch", "Hash Mismatch"),
    spelling(ProblemCode::busy, "busy", "Too Many Requests"),
    spelling(ProblemCode::deadlineExceeded, "deadlineExceeded", "Deadline Exceeded"),
    spelling(ProblemCode::unavailable, "unavailable", "Service Unavailable"),
    spelling(ProblemCode::insufficientStorage, "insufficientStorage", "Insufficient Storage"),
    spelling(ProblemCode::backend, "backend", "Graphics Backend Failure"),
    spelling(ProblemCode::internal, "internal", "Internal Server Error"),
};
static_assert(spellsAll<ProblemCode>());

template <>
inline constexpr auto kRows<Problem> =
    rows("ProblemEntry", "One problem.", field("code", &Problem::code, {.says = "Kind of problem."}),
         field("pointer", &Problem::pointer, {.says = "Where: a JSON pointer, a query key or the name of a part."}),
         field("detail", &Problem::detail, {.says = "One sentence for people."}),
         field("limit", &Problem::limit, {.says = "What would have been accepted."}),
         field("actual", &Problem::actual, {.says = "What was sent, shortened."}));
static_assert(kRowsAreComplete<Problem>);

} // namespace gnomon
