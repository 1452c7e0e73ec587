#include "renderer/scene/container/gltf_resources.h"

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

} // namespace

std::vector<ResourceBytes> readBuffers(const json& document, std::optional<BytesView> binary, const SceneBundle& bundle,
                                       Findings& findings) {
  const json& buffers = arrayAt(document, "buffers");
  std::vector<ResourceBytes> read(buffers.size());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
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

std::vector<BytesView> readBufferViews(const json& document, const std::vector<ResourceBytes>& buffers,
                                       Findings& findings) {
  const json& views = arrayAt(document, "bufferViews");
  const json& bufferObjects = arrayAt(document, "buffers");
  std::vector<BytesView> read(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::uint64_t buffer = unsignedAt(views[i], "buffer");
    const std::uint64_t offset = unsignedAt(views[i], "byteOffset");
    const std::uint64_t length = unsignedAt(views[i], "byteLength");
    const std::uint64_t stride = unsignedAt(views[i], "byteStride");
    if (stride % 4 != 0) {
      findings.invalid(pointerTo("/bufferViews", i) + "/byteStride", "The stride is not a multiple of 4.", {},
                       std::to_string(stride));
    }
    const std::uint64_t whole = unsignedAt(bufferObjects[buffer], "byteLength");
    if (length > whole || offset > whole - length) {
      findings.invalid(pointerTo("/bufferViews", i), "The buffer view reaches past the end of its buffer.",
                       std::to_string(whole) + " bytes",
                       std::to_string(offset) + " + " + std::to_string(length) + " bytes");
      continue;
    }
    const BytesView bytes = buffers[buffer].view();
    if (bytes.size() >= whole) read[i] = bytes.subspan(offset, length); // a shorter buffer is already refused
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
