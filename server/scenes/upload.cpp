#include "server/scenes/upload.h"

#include <algorithm>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"
#include "server/http/url.h"
#include "server/system/file_descriptor.h"
#include "server/wire/bundle.h"

namespace gnomon {

Result<std::vector<FormPart>> partsOf(const HttpRequest& request, const Limits& limits) {
  const auto boundary = boundaryOf(headerValue(request.headers, "content-type").value_or(""));
  if (!boundary) return Problem{ProblemCode::malformed, "", "The Content-Type of the form names no boundary.", "", ""};
  constexpr std::size_t kOthers = 3; // the model, the spec and strict
  return parseMultipart(asText(request.body), *boundary, limits.maxBundleFiles + kOthers);
}

Result<SceneBundle> bundleFromParts(const std::vector<FormPart>& parts, const std::vector<std::string>& others) {
  SceneBundle bundle;
  Problems problems;
  bool hasModel = false;
  for (const FormPart& part : parts) {
    if (std::find(others.begin(), others.end(), part.name) != others.end()) continue;
    const auto content = [&] { return Bytes(part.content.begin(), part.content.end()); };
    if (part.name == "scene") {
      if (hasModel) {
        problems.push_back({ProblemCode::invalidValue, "scene", "The form has two parts of this name.", "", ""});
      }
      bundle.model = content();
      hasModel = true;
      continue;
    }
    if (part.name == "strict") {
      if (part.content != "true" && part.content != "false") {
        problems.push_back({ProblemCode::invalidValue, "strict", "The value is neither true nor false.",
                            "true or false", asciiExcerpt(part.content)});
      }
      bundle.strict = part.content == "true";
      continue;
    }
    const bool byFileName = part.name == "file" || part.name == "files";
    const std::string name = byFileName ? part.fileName.value_or("") : part.name;
    if (!isBundleFileName(name)) {
      problems.push_back(
          {ProblemCode::invalidValue, asciiExcerpt(part.name),
           "A file's name must be a relative path of at most 255 bytes, without '.', '..', ':' and '\\'.", "",
           asciiExcerpt(name)});
    } else if (!bundle.files.emplace(name, content()).second) {
      problems.push_back(
          {ProblemCode::invalidValue, asciiExcerpt(part.name), "Two files have this name.", "", asciiExcerpt(name)});
    }
  }
  if (!hasModel) {
    problems.push_back(
        {ProblemCode::invalidValue, "scene", "The form has no part of this name; it holds the model.", "", ""});
  }
  if (!problems.empty()) return problems;
  return bundle;
}

Result<PackedBundle> packed(const SceneBundle& bundle) {
  MemoryFileWriter writer;
  Sha256 hash;
  PackedBundle made;
  writeBundle(bundle, [&](std::span<const std::uint8_t> piece) {
    writer.add(piece);
    hash.add(piece);
    made.bytes += piece.size();
  });
  auto file = writer.finish();
  if (!file) return Problem{ProblemCode::unavailable, "", "There is no memory for the scene.", "", ""};
  made.id = hash.hex();
  made.file = std::make_shared<FileDescriptor>(*std::move(file));
  return made;
}

Status checkBundleSize(const SceneBundle& bundle, const Limits& limits) {
  std::size_t bytes = bundle.model.size();
  for (const auto& [name, content] : bundle.files) {
    bytes += content.size();
  }
  if (bytes > limits.maxSceneBytes) {
    return Problem{ProblemCode::tooLarge, "", "The model and its files together are too large.",
                   std::to_string(limits.maxSceneBytes) + " bytes", std::to_string(bytes) + " bytes"};
  }
  return Done{};
}

Result<SceneBundle> bundleFromRequest(HttpRequest& request, const Limits& limits) {
  const auto strict = queryFlag(request.query, "strict");
  if (!strict) return strict.problems();
  SceneBundle bundle;
  if (mediaType(headerValue(request.headers, "content-type").value_or("")) == "multipart/form-data") {
    const auto parts = partsOf(request, limits);
    if (!parts) return parts.problems();
    auto made = bundleFromParts(*parts, {});
    if (!made) return made;
    bundle = *std::move(made);
    request.body = Bytes();
  } else {
    bundle.model = std::move(request.body);
  }
  bundle.strict = bundle.strict || *strict;
  if (bundle.model.empty()) return Problem{ProblemCode::malformed, "", "The model is empty.", "", ""};
  if (auto fits = checkBundleSize(bundle, limits); !fits) return std::move(fits).problems();
  return bundle;
}

} // namespace gnomon
