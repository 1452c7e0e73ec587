#include "server/http/multipart.h"

#include <algorithm>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxPartHead = 8 * 1024;

Problem malformedForm(std::string detail) {
  return {ProblemCode::malformed, "", std::move(detail), "", ""};
}

bool isBoundary(std::string_view text) {
  constexpr std::string_view kMarks = "'()+_,-./:=? ";
  return !text.empty() && text.size() <= 70 && text.back() != ' ' && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

/// Browsers escape the three characters that a quoted name can't contain (WHATWG form encoding).
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view escape = text.substr(i, 3);
    if (escape == "%22" || escape == "%0D" || escape == "%0A") {
      plain.push_back(escape == "%22" ? '"' : escape == "%0D" ? '\r' : '\n');
      i += 2;
    } else {
      plain.push_back(text[i]);
    }
  }
  return plain;
}

/// `; key=value` and `; key="value"`, one at a time from the front of `text`. False at the end or where it is broken.
bool nextParameter(std::string_view& text, std::string& key, std::string& value) {
  text = trimmed(text);
  if (text.empty() || text.front() != ';') return false;
  text = trimmed(text.substr(1));
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return false;
  key = lowerCase(trimmed(text.substr(0, equals)));
  text = trimmed(text.substr(equals + 1));
  value.clear();
  if (text.empty() || text.front() != '"') {
    const std::size_t end = std::min(text.find(';'), text.size());
    value = trimmed(text.substr(0, end));
    text.remove_prefix(end);
    return true;
  }
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"') {
      text.remove_prefix(i + 1);
      return true;
    }
    if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\\')) ++i;
    value.push_back(text[i]);
  }
  return false; // the quote is never closed
}

Status readDisposition(std::string_view value, FormPart& part) {
  const std::size_t end = std::min(value.find(';'), value.size());
  if (lowerCase(trimmed(value.substr(0, end))) != "form-data") {
    return malformedForm("A part's Content-Disposition is not form-data.");
  }
  std::string_view rest = value.substr(end);
  std::string key;
  std::string text;
  bool named = false;
  while (nextParameter(rest, key, text)) {
    if ((key == "name" && named) || (key == "filename" && part.fileName)) {
      return malformedForm("A part's Content-Disposition repeats a parameter.");
    }
    if (key == "name") {
      part.name = unescaped(text);
      named = true;
    } else if (key == "filename") {
      part.fileName = unescaped(text);
    } else if (key != "filename*") {
      return malformedForm("A part's Content-Disposition has an unknown parameter.");
    }
  }
  if (!trimmed(rest).empty() || !named || part.name.empty()) {
    return malformedForm("A part's Content-Disposition has no name or is malformed.");
  }
  return Done{};
}

/// The part's headers, from the front of `rest`, which is left at its content.
Result<FormPart> readPartHead(std::string_view& rest) {
  FormPart part;
  bool disposed = false;
  const std::size_t end = rest.find("\r\n\r\n");
  if (end == std::string_view::npos || end > kMaxPartHead) return malformedForm("A part's headers do not end.");
  std::string_view head = rest.substr(0, end + 2);
  rest.remove_prefix(end + 4);
  while (!head.empty()) {
    const std::size_t lineEnd = head.find("\r\n");
    const std::string_view line = head.substr(0, lineEnd);
    head.remove_prefix(lineEnd + 2);
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return malformedForm("A part's header is not a name, a colon and a value.");
    const std::string name = lowerCase(line.substr(0, colon));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (name == "content-disposition") {
      if (disposed) return malformedForm("A part has two Content-Dispositions.");
      if (auto read = readDisposition(value, part); !read) return std::move(read).problems();
      disposed = true;
    } else if (name == "content-type") {
      part.contentType = value;
    } else if (name == "content-transfer-encoding" && lowerCase(value) != "binary" && lowerCase(value) != "8bit" &&
               lowerCase(value) != "7bit") {
      return malformedForm("A part's Content-Transfer-Encoding is not binary.");
    }
  }
  if (!disposed) return malformedForm("A part has no Content-Disposition.");
  return part;
}

} // namespace

std::optional<std::string> boundaryOf(std::string_view contentType) {
  std::string_view rest = contentType.substr(std::min(contentType.find(';'), contentType.size()));
  std::string key;
  std::string value;
  while (nextParameter(rest, key, value)) {
    if (key == "boundary") return isBoundary(value) ? std::optional(value) : std::nullopt;
  }
  return std::nullopt;
}

Result<std::vector<FormPart>> parseMultipart(std::string_view body, std::string_view boundary, std::size_t maxParts) {
  const std::string opening = "--" + std::string(boundary);
  const std::string delimiter = "\r\n" + opening;
  std::string_view rest = body;
  if (!rest.starts_with(opening)) {
    return malformedForm("The form does not begin with the boundary that its Content-Type names.");
  }
  rest.remove_prefix(opening.size());
  std::vector<FormPart> parts;
  while (!rest.starts_with("--")) {
    if (!rest.starts_with("\r\n")) return malformedForm("A boundary line contains more than the boundary.");
    rest.remove_prefix(2);
    if (parts.size() == maxParts) {
      return Problem{ProblemCode::tooLarge, "", "The form has too many parts.", std::to_string(maxParts), ""};
    }
    auto part = readPartHead(rest);
    if (!part) return std::move(part).problems();
    const std::size_t end = rest.find(delimiter);
    if (end == std::string_view::npos) return malformedForm("The form ends inside a part.");
    part->content = rest.substr(0, end);
    rest.remove_prefix(end + delimiter.size());
    parts.push_back(*std::move(part));
  }
  rest.remove_prefix(2);
  if (!rest.empty() && rest != "\r\n") return malformedForm("Bytes follow the form's end.");
  return parts;
}

} // namespace gnomon
