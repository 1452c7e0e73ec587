#include "renderer/scene/decode/meshopt_decode.h"

#include <algorithm>
#include <meshoptimizer.h>

namespace gnomon {

namespace {

/// What the first byte of a stream holds: the format in the upper four bits, its version in the lower four.
struct StreamKind {
  std::uint8_t format = 0;
  std::uint8_t newestVersion = 0;
};

StreamKind kindOf(MeshoptMode mode) {
  switch (mode) {
    case MeshoptMode::attributes:
      return {0xA0, 0};
    case MeshoptMode::triangles:
      return {0xE0, 1};
    case MeshoptMode::indices:
      break;
  }
  return {0xD0, 1};
}

/// The fewest bytes that hold the elements (EXT_meshopt_compression, Appendix A): a triangle takes a byte and an index
/// takes one, 64 values of one byte of an attribute take a byte, and each stream has a header and a tail.
std::uint64_t fewestBytes(const MeshoptView& view) {
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

bool mayHold(const MeshoptView& view, std::span<const std::uint8_t> compressed, Findings& findings) {
  const std::uint64_t fewest = fewestBytes(view);
  if (fewest > compressed.size()) {
    findings.invalid(view.pointer + "/count", "The compressed data can't hold as many elements.",
                     std::to_string(compressed.size()) + " bytes",
                     std::to_string(view.count) + " elements, which take " + std::to_string(fewest) + " or more");
    return false;
  }
  const StreamKind kind = kindOf(view.mode);
  const std::uint8_t header = compressed.front();
  if ((header & 0xF0) == kind.format && (header & 0x0F) > kind.newestVersion) {
    findings.unsupported(view.pointer, "The data is of version " + std::to_string(header & 0x0F) +
                                           " of its compression; versions to " + std::to_string(kind.newestVersion) +
                                           " are supported.");
    return false;
  }
  return true;
}

bool decode(const MeshoptView& view, std::span<const std::uint8_t> compressed, Bytes& elements) {
  switch (view.mode) {
    case MeshoptMode::attributes:
      return meshopt_decodeVertexBuffer(elements.data(), view.count, view.byteStride, compressed.data(),
                                        compressed.size()) == 0;
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(elements.data(), view.count, view.byteStride, compressed.data(),
                                       compressed.size()) == 0;
    case MeshoptMode::indices:
      break;
  }
  return meshopt_decodeIndexSequence(elements.data(), view.count, view.byteStride, compressed.data(),
                                     compressed.size()) == 0;
}

void applyFilter(const MeshoptView& view, Bytes& elements) {
  switch (view.filter) {
    case MeshoptFilter::none:
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

Bytes decodeMeshopt(const MeshoptView& view, std::span<const std::uint8_t> compressed, DecodeBudget& budget,
                    Findings& findings) {
  if (!mayHold(view, compressed, findings)) return {};
  if (!budget.take(view.decodedBytes(), view.pointer + "/count", findings)) return {};
  Bytes elements(view.decodedBytes());
  if (!decode(view, compressed, elements)) {
    findings.invalid(view.pointer, "The compressed data is damaged.");
    return {};
  }
  applyFilter(view, elements);
  return elements;
}

} // namespace gnomon
