#include "renderer/scene/container/resources.h"

#include <algorithm>
#include <optional>

#include "protocol/base/bytes.h"
#include "protocol/base/scene_bundle.h"
#include "renderer/scene/decode/meshopt.h"
#include "renderer/scene/findings.h"

namespace gnomon {

namespace {

Problem refused(ProblemCode code, const std::string& pointer, std::string detail, std::string_view uri) {
  return {code, pointer, std::move(detail), "data: or the name of an uploaded file", inQuotes(uri)};
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

constexpr const char* kNeedsLeftOut = "what needs it is left out";

using BytesView = std::span<const std::uint8_t>;

/// Ranges of the buffers.
struct Parts {
  const std::vector<gltf::Buffer>& objects;
  const std::vector<ResourceBytes>& buffers;
  Findings& findings;

  /// As much of it as the buffer has.
  BytesView at(std::size_t buffer, std::uint64_t offset, std::uint64_t length, const std::string& pointer) const {
    const std::uint64_t whole = objects[buffer].byteLength;
    const BytesView bytes = buffers[buffer].view();
    const std::uint64_t start = std::min<std::uint64_t>(offset, bytes.size());
    const BytesView part = bytes.subspan(start, std::min<std::uint64_t>(length, bytes.size() - start));
    if (length > whole || offset > whole - length) {
      findings.repair({"A buffer view reaches past the end of its buffer",
                       part.size() < length ? "what lies beyond is left out" : "its bytes are there, and are read"},
                      pointer, std::to_string(whole) + " bytes",
                      std::to_string(offset) + " + " + std::to_string(length) + " bytes");
    }
    return part;
  }
};

void checkStride(const gltf::BufferView& view, const std::string& pointer, Findings& findings) {
  if (!view.byteStride) return;
  const std::uint64_t stride = *view.byteStride;
  constexpr std::uint64_t kMostStride = 252; // glTF 2.0, bufferView.byteStride
  if (stride == 0) {
    findings.repair({"A byteStride is 0", "the elements are read tightly packed"}, pointer);
  } else if (stride % 4 != 0 || stride > kMostStride) {
    findings.repair({"A byteStride is not a multiple of 4 up to 252", "it is followed"}, pointer, {},
                    std::to_string(stride));
  }
}

/// What a part of the file that has no bytes comes to.
void leaveOut(Problem problem, Findings& findings) {
  Findings part;
  part.refuse(std::move(problem));
  findings.leaveOut(std::move(part), kNeedsLeftOut);
}

Bytes decoded(const gltf::BufferView& view, const Parts& parts, const std::vector<bool>& fallbacks,
              const std::string& pointer, DecodeBudget& budget, Findings& findings) {
  const gltf::Meshopt& meshopt = *view.meshopt;
  const std::string at = pointer + "/extensions/" + std::string(meshopt.extension);
  Findings ofView;
  Bytes bytes;
  if (fallbacks[meshopt.buffer]) {
    ofView.invalid(at + "/buffer", "The compressed data can't lie in a fallback buffer.");
  } else if (isSoundMeshopt(view, at, ofView)) {
    const BytesView compressed = parts.at(meshopt.buffer, meshopt.byteOffset, meshopt.byteLength, at);
    bytes = decodeMeshopt(meshopt, at, compressed, budget, ofView);
  }
  findings.leaveOut(std::move(ofView), kNeedsLeftOut);
  return bytes;
}

/// Nothing where it can't be had: what needs it is left out.
std::optional<ResourceBytes> bytesAt(const std::string& uri, const SceneBundle& bundle, const std::string& pointer,
                                     Findings& findings) {
  auto bytes = resolveUri(uri, bundle, pointer);
  if (!bytes) {
    for (Problem& problem : std::move(bytes).problems()) leaveOut(std::move(problem), findings);
    return std::nullopt;
  }
  if (schemeOf(uri) == "data" && uri.substr(0, uri.find(',')).find(";;") != std::string::npos) {
    findings.repair({"The media type of a data: URI is broken", "its data are read"}, pointer);
  }
  const auto named = fileUri(uri);
  if (named && named->hasBackslash) {
    findings.repair({"A file name has a backslash", "it is read as a slash"}, pointer, {}, inQuotes(uri));
  }
  return *std::move(bytes);
}

} // namespace

std::span<const std::uint8_t> ResourceBytes::view() const {
  if (const Bytes* owned = std::get_if<Bytes>(&bytes_)) return *owned;
  return std::get<0>(bytes_);
}

Result<ResourceBytes> resolveUri(std::string_view uri, const SceneBundle& bundle, const std::string& pointer) {
  const std::string scheme = schemeOf(uri);
  if (scheme == "data") return resolveDataUri(uri, pointer);
  const auto named = fileUri(uri);
  const auto file = named ? bundle.files.find(named->name) : bundle.files.end();
  if (file != bundle.files.end()) return ResourceBytes(std::span<const std::uint8_t>(file->second));
  if (!scheme.empty()) {
    return refused(ProblemCode::unsupportedFeature, pointer,
                   "The URI refers to something that is no file beside the model, which is never opened.", uri);
  }
  if (!named) {
    return refused(ProblemCode::invalidScene, pointer,
                   "The URI names no file, has an invalid percent escape or contains control characters.", uri);
  }
  if (named->isOutside) {
    return refused(ProblemCode::invalidScene, pointer,
                   "The URI is an absolute path or leads out of the folder of the model.", uri);
  }
  return Problem{
      ProblemCode::invalidScene, pointer, "The glTF refers to a file that is not there.", {}, inQuotes(named->name)};
}

std::vector<ResourceBytes> readBuffers(const gltf::Model& model, const std::vector<bool>& fallbacks,
                                       std::optional<BytesView> binary, const SceneBundle& bundle, Findings& findings) {
  const std::vector<gltf::Buffer>& buffers = model.buffers;
  std::vector<ResourceBytes> read(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (fallbacks[i] || buffers[i].faulty) continue;
    const std::string pointer = pointerTo("/buffers", i);
    if (const auto& uri = buffers[i].uri) {
      auto bytes = bytesAt(*uri, bundle, pointer + "/uri", findings);
      if (!bytes) continue;
      read[i] = *std::move(bytes);
    } else if (i == 0 && binary) {
      read[i] = ResourceBytes(*binary);
    } else {
      leaveOut({ProblemCode::invalidScene, pointer + "/uri",
                "A buffer has no bytes: neither a uri nor the GLB's BIN chunk."},
               findings);
      continue;
    }
    const std::uint64_t claimed = buffers[i].byteLength;
    if (claimed > read[i].view().size()) {
      findings.repair({"A buffer claims more bytes than it has", "what lies beyond is left out"},
                      pointer + "/byteLength", std::to_string(read[i].view().size()), std::to_string(claimed));
    }
  }
  return read;
}

BufferViews readBufferViews(const gltf::Model& model, const std::vector<ResourceBytes>& buffers,
                            const std::vector<bool>& fallbacks, DecodeBudget& budget, Findings& findings) {
  const std::vector<gltf::BufferView>& views = model.bufferViews;
  BufferViews read{std::vector<BytesView>(views.size()), std::vector<Bytes>(views.size())};
  const Parts parts{model.buffers, buffers, findings};
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].faulty) continue;
    const std::string pointer = pointerTo("/bufferViews", i);
    checkStride(views[i], pointer + "/byteStride", findings);
    if (views[i].meshopt) {
      read.decoded[i] = decoded(views[i], parts, fallbacks, pointer, budget, findings);
      read.bytes[i] = read.decoded[i];
    } else if (fallbacks[views[i].buffer]) {
      leaveOut({ProblemCode::invalidScene, pointer + "/buffer",
                "A buffer view lies in a fallback buffer, but is not compressed."},
               findings);
    } else {
      read.bytes[i] = parts.at(views[i].buffer, views[i].byteOffset, views[i].byteLength, pointer);
    }
  }
  return read;
}

std::vector<ResourceBytes> readImages(const gltf::Model& model, const std::vector<BytesView>& bufferViews,
                                      const SceneBundle& bundle, Findings& findings) {
  const std::vector<gltf::Image>& images = model.images;
  std::vector<ResourceBytes> read(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string pointer = pointerTo("/images", i);
    const auto& uri = images[i].uri;
    const int view = images[i].bufferView;
    if (view >= 0) {
      read[i] = ResourceBytes(bufferViews[static_cast<std::size_t>(view)]);
      if (uri) findings.repair({"An image has a uri and a bufferView", "the bufferView is read"}, pointer);
    } else if (!uri) {
      leaveOut({ProblemCode::invalidScene, pointer, "An image has neither a uri nor a bufferView."}, findings);
    } else if (auto bytes = bytesAt(*uri, bundle, pointer + "/uri", findings)) {
      read[i] = *std::move(bytes);
    }
  }
  return read;
}

} // namespace gnomon
