#include "renderer/scene/decode/meshopt.h"

#include <algorithm>
#include <array>
#include <meshoptimizer.h>

#include "renderer/core/stop.h"
#include "renderer/scene/container/resources.h"

namespace gnomon {

namespace {

/// The strides that a mode and a filter leave; empty if the filter does not go with the mode.
std::string stridesOf(MeshoptMode mode, MeshoptFilter filter) {
  if (mode != MeshoptMode::attributes) return filter == MeshoptFilter::none ? "2 or 4" : "";
  if (filter == MeshoptFilter::octahedral) return "4 or 8";
  return filter == MeshoptFilter::quaternion ? "8" : "a multiple of 4";
}

bool strideFits(std::uint64_t stride, MeshoptMode mode, MeshoptFilter filter) {
  if (mode != MeshoptMode::attributes) return stride == 2 || stride == 4;
  if (filter == MeshoptFilter::octahedral) return stride == 4 || stride == 8;
  return filter == MeshoptFilter::quaternion ? stride == 8 : stride % 4 == 0;
}

/// What a mode's streams are: the format in the upper four bits of the first byte, its version in the lower four.
struct Stream {
  std::uint8_t format = 0;
  std::uint8_t newestVersion = 0;
  int (*decode)(void* elements, std::size_t count, std::size_t stride, const unsigned char* bytes, std::size_t size);
};

constexpr std::array<Stream, 3> kStreams{{{0xA0, 0, meshopt_decodeVertexBuffer},
                                          {0xE0, 1, meshopt_decodeIndexBuffer},
                                          {0xD0, 1, meshopt_decodeIndexSequence}}};

const Stream& streamOf(MeshoptMode mode) {
  return kStreams[static_cast<std::size_t>(mode)];
}

/// The fewest bytes that hold the elements (EXT_meshopt_compression, Appendix A), with header and tail.
std::uint64_t fewestBytes(const gltf::Meshopt& view) {
  switch (view.mode) {
    case MeshoptMode::triangles:
      return 1 + view.count / 3 + 16;
    case MeshoptMode::indices:
      return 1 + view.count + 4;
    case MeshoptMode::attributes:
      break;
  }
  const std::uint64_t runs = (view.count + 63) / 64;
  return 1 + runs * view.byteStride + std::max<std::uint64_t>(view.byteStride, 32);
}

bool mayHold(const gltf::Meshopt& view, const std::string& pointer, std::span<const std::uint8_t> compressed,
             Findings& findings) {
  const std::uint64_t fewest = fewestBytes(view);
  if (fewest > compressed.size()) {
    findings.invalid(pointer + "/count", "The compressed data is too short for its number of elements.",
                     std::to_string(compressed.size()) + " bytes",
                     std::to_string(view.count) + " elements, which take " + std::to_string(fewest) + " or more");
    return false;
  }
  const Stream& kind = streamOf(view.mode);
  const std::uint8_t header = compressed.front();
  if ((header & 0xF0) == kind.format && (header & 0x0F) > kind.newestVersion) {
    findings.unsupported(pointer, "The compressed data has version " + std::to_string(header & 0x0F) +
                                      "; versions up to " + std::to_string(kind.newestVersion) + " are supported.");
    return false;
  }
  return true;
}

void applyFilter(const gltf::Meshopt& view, Bytes& elements) {
  switch (view.filter) {
    case MeshoptFilter::none:
    case MeshoptFilter::color:
      return;
    case MeshoptFilter::octahedral:
      return meshopt_decodeFilterOct(elements.data(), view.count, view.byteStride);
    case MeshoptFilter::quaternion:
      return meshopt_decodeFilterQuat(elements.data(), view.count, view.byteStride);
    case MeshoptFilter::exponential:
      return meshopt_decodeFilterExp(elements.data(), view.count, view.byteStride);
  }
}

} // namespace

std::vector<bool> meshoptFallbacks(const gltf::Model& model, bool hasBinary) {
  std::vector<bool> plain(model.buffers.size(), false);
  std::vector<bool> compressed(model.buffers.size(), false);
  for (const gltf::BufferView& view : model.bufferViews) {
    if (view.faulty) continue;
    (view.meshopt ? compressed : plain)[view.buffer] = true;
  }
  std::vector<bool> fallbacks(model.buffers.size(), false);
  for (std::size_t i = 0; i < fallbacks.size(); ++i) {
    const bool hasBytes = model.buffers[i].uri || (i == 0 && hasBinary);
    fallbacks[i] = model.buffers[i].fallback || (!hasBytes && compressed[i] && !plain[i]);
  }
  return fallbacks;
}

bool isSoundMeshopt(const gltf::BufferView& bufferView, const std::string& pointer, Findings& findings) {
  const gltf::Meshopt& view = *bufferView.meshopt;
  if (view.filter == MeshoptFilter::color) {
    findings.unsupported(pointer + "/filter", "The filter COLOR is not supported.");
    return false;
  }
  const std::string strides = stridesOf(view.mode, view.filter);
  if (strides.empty()) {
    findings.invalid(pointer + "/filter", "Index modes allow no filter.", "NONE");
    return false;
  }
  if (!strideFits(view.byteStride, view.mode, view.filter)) {
    findings.invalid(pointer + "/byteStride", "The mode and the filter do not allow this stride.", strides,
                     std::to_string(view.byteStride));
    return false;
  }
  if (view.mode == MeshoptMode::triangles && view.count % 3 != 0) {
    findings.invalid(pointer + "/count", "The last triangle is incomplete.", "a multiple of 3",
                     std::to_string(view.count));
    return false;
  }
  const std::uint64_t length = bufferView.byteLength;
  if (length != view.decodedBytes()) {
    findings.invalid(pointer + "/count", "The elements do not fill the buffer view.", std::to_string(length) + " bytes",
                     std::to_string(view.count) + " elements of " + std::to_string(view.byteStride) + " bytes");
    return false;
  }
  if (bufferView.byteStride.value_or(0) != 0 && bufferView.byteStride != view.byteStride) {
    findings.invalid(pointer + "/byteStride", "The stride differs from that of the buffer view.",
                     std::to_string(*bufferView.byteStride), std::to_string(view.byteStride));
    return false;
  }
  return true;
}

Bytes decodeMeshopt(const gltf::Meshopt& view, const std::string& pointer, std::span<const std::uint8_t> compressed,
                    DecodeBudget& budget, Findings& findings) {
  stopIfAsked();
  if (!mayHold(view, pointer, compressed, findings)) return {};
  if (!budget.take(view.decodedBytes(), pointer + "/count", findings)) return {};
  Bytes elements(view.decodedBytes());
  if (streamOf(view.mode).decode(elements.data(), view.count, view.byteStride, compressed.data(), compressed.size()) !=
      0) {
    findings.invalid(pointer, "The compressed data is damaged.");
    return {};
  }
  applyFilter(view, elements);
  return elements;
}

} // namespace gnomon
