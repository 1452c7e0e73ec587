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
    spelling<ProblemCode::malformed>("Malformed Request"),
    spelling<ProblemCode::invalidValue>("Invalid Value"),
    spelling<ProblemCode::notFound>("Not Found"),
    spelling<ProblemCode::methodNotAllowed>("Method Not Allowed"),
    spelling<ProblemCode::unauthorized>("Unauthorized"),
    spelling<ProblemCode::forbidden>("Forbidden"),
    spelling<ProblemCode::misdirected>("Misdirected Request"),
    spelling<ProblemCode::notAcceptable>("Not Acceptable"),
    spelling<ProblemCode::preconditionFailed>("Precondition Failed"),
    spelling<ProblemCode::lengthRequired>("Length Required"),
    spelling<ProblemCode::tooLarge>("Content Too Large"),
    spelling<ProblemCode::unsupportedMediaType>("Unsupported Media Type"),
    spelling<ProblemCode::invalidScene>("Invalid Scene"),
    spelling<ProblemCode::unsupportedFeature>("Unsupported Feature"),
    spelling<ProblemCode::hashMismatch>("Hash Mismatch"),
    spelling<ProblemCode::busy>("Too Many Requests"),
    spelling<ProblemCode::deadlineExceeded>("Deadline Exceeded"),
    spelling<ProblemCode::unavailable>("Service Unavailable"),
    spelling<ProblemCode::insufficientStorage>("Insufficient Storage"),
    spelling<ProblemCode::backend>("Graphics Backend Failure"),
    spelling<ProblemCode::internal>("Internal Server Error"),
};

template <>
inline constexpr auto kRows<Problem> =
    rows("ProblemEntry", "One problem.", field<&Problem::code>("Kind of problem."),
         field<&Problem::pointer>("Where: a JSON pointer, a query key or the name of a part."),
         field<&Problem::detail>("One sentence for people."), field<&Problem::limit>("What would have been accepted."),
         field<&Problem::actual>("What was sent, shortened."));

} // namespace gnomon
