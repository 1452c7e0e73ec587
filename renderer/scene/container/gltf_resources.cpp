#include "renderer/scene/container/gltf_resources.h"

#include "renderer/scene/decode/meshopt_decode.h"
#include "renderer/scene/decode/meshopt_view.h"

namespace gnomon {

namespace {

using nlohmann::json;
using BytesView = std::span<const std::uint8_t>;

const json kNone = json::array();

const json& arrayAt(const json& document, const char* key) {
  const auto member = document.find(key);
  return member == document.end() ? kNone : *member;
}

std::uint64_t unsignedAt(const json& object, const char* key) {
  const auto member = object.find(key);
  return member == object.end() ? 0 : member->get<std::uint64_t>();
}

const std::string* stringAt(const json& object, const char* key) {
  const auto member = object.find(key);
  return member == object.end() ? nullptr : member->get_ptr<const std::string*>();
}

/// Ranges of the buffers.
struct Parts {
  const json& objects;
  const std::vector<ResourceBytes>& buffers;
  const std::vector<bool>& fallbacks;
  Findings& findings;

  /// Nothing, and a problem, past the end of the buffer; nothing of buffers that have no bytes.
  std::optional<BytesView> at(std::uint64_t buffer, std::uint64_t offset, std::uint64_t length,
                              const std::string& pointer) const {
    const std::uint64_t whole = unsignedAt(objects[buffer], "byteLength");
    if (length > whole || offset > whole - length) {
      findings.invalid(pointer, "The buffer view reaches past the end of its buffer.", std::to_string(whole) + " bytes",
                       std::to_string(offset) + " + " + std::to_string(length) + " bytes");
      return std::nullopt;
    }
    const BytesView bytes = buffers[buffer].view();
    if (bytes.size() < whole) return std::nullopt; // refused with the buffer, or a fallback
    return bytes.subspan(offset, length);
  }
};

Bytes decoded(const json& view, const Parts& parts, const std::string& pointer, DecodeBudget& budget,
              Findings& findings) {
  const auto meshopt = readMeshopt(view, pointer, findings);
  if (!meshopt) return {};
  if (parts.fallbacks[meshopt->buffer]) {
    findings.invalid(meshopt->pointer + "/buffer", "The compressed data can't lie in a fallback buffer.");
    return {};
  }
  const auto compressed = parts.at(meshopt->buffer, meshopt->byteOffset, meshopt->byteLength, meshopt->pointer);
  return compressed ? decodeMeshopt(*meshopt, *compressed, budget, findings) : Bytes{};
}

} // namespace

std::vector<ResourceBytes> readBuffers(const json& document, const std::vector<bool>& fallbacks,
                                       std::optional<BytesView> binary, const SceneBundle& bundle, Findings& findings) {
  const json& buffers = arrayAt(document, "buffers");
  std::vector<ResourceBytes> read(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    if (fallbacks[i]) continue;
    const std::string pointer = pointerTo("/buffers", i);
    if (const std::string* uri = stringAt(buffers[i], "uri")) {
      auto bytes = resolveUri(*uri, bundle, pointer + "/uri");
      if (!bytes) {
        findings.take(std::move(bytes).problems());
        continue;
      }
      read[i] = *std::move(bytes);
    } else if (i == 0 && binary) {
      read[i] = ResourceBytes(*binary);
    } else {
      findings.invalid(pointer + "/uri", "The buffer has no bytes: neither a uri nor the GLB's BIN chunk.");
      continue;
    }
    const std::uint64_t claimed = unsignedAt(buffers[i], "byteLength");
    if (claimed > read[i].view().size()) {
      findings.invalid(pointer + "/byteLength", "The buffer claims more bytes than it has.",
                       std::to_string(read[i].view().size()), std::to_string(claimed));
    }
  }
  return read;
}

BufferViews readBufferViews(const json& document, const std::vector<ResourceBytes>& buffers,
                            const std::vector<bool>& fallbacks, DecodeBudget& budget, Findings& findings) {
  const json& views = arrayAt(document, "bufferViews");
  BufferViews read{std::vector<BytesView>(views.size()), std::vector<Bytes>(views.size())};
  const Parts parts{arrayAt(document, "buffers"), buffers, fallbacks, findings};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string pointer = pointerTo("/bufferViews", i);
    const std::uint64_t stride = unsignedAt(views[i], "byteStride");
    if (stride % 4 != 0) {
      findings.invalid(pointer + "/byteStride", "The stride is not a multiple of 4.", {}, std::to_string(stride));
    }
    const auto part = parts.at(unsignedAt(views[i], "buffer"), unsignedAt(views[i], "byteOffset"),
                               unsignedAt(views[i], "byteLength"), pointer);
    if (hasMeshopt(views[i])) {
      read.decoded[i] = decoded(views[i], parts, pointer, budget, findings);
      read.bytes[i] = read.decoded[i];
    } else if (parts.fallbacks[unsignedAt(views[i], "buffer")]) {
      findings.invalid(pointer + "/buffer", "Only compressed buffer views may lie in a fallback buffer.");
    } else if (part) {
      read.bytes[i] = *part;
    }
  }
  return read;
}

std::vector<ResourceBytes> readImages(const json& document, const std::vector<BytesView>& bufferViews,
                                      const SceneBundle& bundle, Findings& findings) {
  const json& images = arrayAt(document, "images");
  std::vector<ResourceBytes> read(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string pointer = pointerTo("/images", i);
    const std::string* uri = stringAt(images[i], "uri");
    const auto view = images[i].find("bufferView");
    if ((uri != nullptr) == (view != images[i].end())) {
      findings.invalid(pointer, "An image needs either a uri or a bufferView.");
    } else if (uri) {
      auto bytes = resolveUri(*uri, bundle, pointer + "/uri");
      if (bytes) {
        read[i] = *std::move(bytes);
      } else {
        findings.take(std::move(bytes).problems());
      }
    } else {
      read[i] = ResourceBytes(bufferViews[view->get<std::size_t>()]);
    }
  }
  return read;
}

} // namespace gnomon
