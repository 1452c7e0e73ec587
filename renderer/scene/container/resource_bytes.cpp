#include "renderer/scene/container/resource_bytes.h"

#include <algorithm>
#include <optional>

#include "protocol/base/encoding.h"
#include "renderer/scene/findings.h"

namespace gnomon {

namespace {

Problem refused(ProblemCode code, const std::string& pointer, std::string detail, std::string_view uri) {
  return {code, pointer, std::move(detail), "data: or the name of an uploaded file", inQuotes(uri)};
}

bool climbs(std::string_view path) {
  while (true) {
    const std::size_t slash = path.find('/');
    if (path.substr(0, slash) == "..") return true;
    if (slash == std::string_view::npos) return false;
    path.remove_prefix(slash + 1);
  }
}

Result<ResourceBytes> resolveDataUri(std::string_view uri, const std::string& pointer) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    return refused(ProblemCode::invalidScene, pointer, "The data: URI has no comma before its data.", uri);
  }
  const std::string_view header = uri.substr(0, comma);
  const std::string_view payload = uri.substr(comma + 1);
  if (header.ends_with(";base64")) {
    if (auto bytes = base64Bytes(payload, Base64Padding::optional)) return ResourceBytes(*std::move(bytes));
    return refused(ProblemCode::invalidScene, pointer, "The data: URI is not valid base64.", uri);
  }
  if (const auto text = percentDecoded(payload)) return ResourceBytes(Bytes(text->begin(), text->end()));
  return refused(ProblemCode::invalidScene, pointer, "The data: URI has an invalid percent escape.", uri);
}

} // namespace

std::span<const std::uint8_t> ResourceBytes::view() const {
  if (const Bytes* owned = std::get_if<Bytes>(&bytes_)) return *owned;
  return std::get<0>(bytes_);
}

Result<ResourceBytes> resolveUri(std::string_view uri, const SceneBundle& bundle, const std::string& pointer) {
  const std::string scheme = schemeOf(uri);
  if (scheme == "data") return resolveDataUri(uri, pointer);
  if (!scheme.empty()) {
    return refused(ProblemCode::unsupportedFeature, pointer, "Nothing outside the upload is opened.", uri);
  }
  const auto name = percentDecoded(uri);
  if (!name) return refused(ProblemCode::invalidScene, pointer, "The URI has an invalid percent escape.", uri);
  const bool control = std::any_of(name->begin(), name->end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (name->empty() || control) {
    return refused(ProblemCode::invalidScene, pointer, "The URI is empty or holds control characters.", uri);
  }
  if (name->front() == '/' || name->find('\\') != std::string::npos || climbs(*name)) {
    return refused(ProblemCode::invalidScene, pointer, "The URI is an absolute path or a path upwards.", uri);
  }
  auto file = bundle.files.find(*name);
  if (file == bundle.files.end() && name->starts_with("./")) file = bundle.files.find(name->substr(2));
  if (file == bundle.files.end()) {
    return Problem{ProblemCode::invalidScene,
                   pointer,
                   "The glTF names the file " + inQuotes(*name) + ", which was not uploaded with it.",
                   {},
                   {}};
  }
  return ResourceBytes(std::span<const std::uint8_t>(file->second));
}

} // namespace gnomon
