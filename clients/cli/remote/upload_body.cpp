#include "clients/cli/remote/upload_body.h"

#include <algorithm>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/base/sha256.h"

namespace gnomon::cli {
namespace {

bool occursIn(const SceneBundle& bundle, const std::string& text) {
  const auto holds = [&](const Bytes& bytes) { return asText(bytes).find(text) != std::string_view::npos; };
  return holds(bundle.model) ||
         std::any_of(bundle.files.begin(), bundle.files.end(), [&](const auto& file) { return holds(file.second); });
}

std::string boundaryFor(const SceneBundle& bundle) {
  std::string boundary = "gnomon-part-boundary";
  for (int i = 0; occursIn(bundle, boundary); ++i) boundary = "gnomon-part-boundary-" + std::to_string(i);
  return boundary;
}

/// As browsers write it (WHATWG, multipart/form-data).
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"')
      text += "%22";
    else
      text += c;
  }
  return text + "\"";
}

void addPart(std::string& body, const std::string& boundary, const std::string& disposition, const Bytes& content) {
  body += "--" + boundary + "\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n";
  body += asText(content);
  body += "\r\n";
}

} // namespace

UploadBody uploadBody(const SceneBundle& bundle) {
  if (bundle.files.empty()) {
    const bool isGlb = asText(bundle.model).starts_with("glTF");
    return {isGlb ? "model/gltf-binary" : "model/gltf+json", std::string(asText(bundle.model))};
  }
  const std::string boundary = boundaryFor(bundle);
  UploadBody upload{"multipart/form-data; boundary=" + boundary, ""};
  addPart(upload.bytes, boundary, "name=\"scene\"; filename=\"scene\"", bundle.model);
  for (const auto& [name, content] : bundle.files) {
    addPart(upload.bytes, boundary, "name=\"file\"; filename=" + quoted(name), content);
  }
  upload.bytes += "--" + boundary + "--\r\n";
  return upload;
}

std::string modelId(const Bytes& model) {
  Sha256 hash;
  hash.add(model);
  return hash.hex();
}

} // namespace gnomon::cli
