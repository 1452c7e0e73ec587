#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon {

/// One part of a multipart/form-data body. `content` is a view of the body.
struct FormPart {
  std::string name;
  std::optional<std::string> fileName;
  std::string contentType; ///< empty = not given
  std::string_view content;
};

/// The boundary that a Content-Type names, 1..70 characters of RFC 2046; nothing when there is none.
std::optional<std::string> boundaryOf(std::string_view contentType);

/// The parts of a body (RFC 7578), in order. Strict: every part is closed, has one Content-Disposition form-data with a
/// name, and at most `maxParts` come. Nothing is copied but the names.
Result<std::vector<FormPart>> parseMultipart(std::string_view body, std::string_view boundary, std::size_t maxParts);

} // namespace gnomon
