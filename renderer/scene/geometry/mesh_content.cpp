#include "renderer/scene/geometry/mesh_content.h"

#include <array>
#include <cstdint>
#include <span>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

void addNumber(Sha256& hash, std::uint64_t number) {
  std::array<std::uint8_t, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(number >> (8 * i));
  hash.add(bytes);
}

std::string hashOf(const AccessorView& view) {
  Sha256 hash;
  const std::size_t elementBytes = static_cast<std::size_t>(view.components) * bytesOf(view.componentType);
  for (const std::uint64_t number :
       {std::uint64_t{view.count}, static_cast<std::uint64_t>(view.components),
        static_cast<std::uint64_t>(view.componentType), std::uint64_t{view.normalized ? 1u : 0u},
        std::uint64_t{view.data == nullptr ? 0 : view.stride}, std::uint64_t{view.sparseCount}}) {
    addNumber(hash, number);
  }
  if (view.data != nullptr && view.count > 0) {
    hash.add(std::span(view.data, view.stride * (view.count - 1) + elementBytes));
  }
  if (view.sparseCount > 0) {
    addNumber(hash, static_cast<std::uint64_t>(view.sparseIndexType));
    addNumber(hash, view.sparseStride);
    hash.add(std::span(view.sparseIndices, view.sparseCount * bytesOf(view.sparseIndexType)));
    hash.add(std::span(view.sparseValues, view.sparseCount * view.sparseStride));
  }
  return hash.hex();
}

} // namespace

std::string MeshContents::of(const PrimitiveSource& source) {
  if (source.deforms()) return {};
  Sha256 hash;
  addNumber(hash, static_cast<std::uint64_t>(source.mode));
  for (const AccessorView* view : {source.positions, source.normals, source.tangents, source.texCoords[0],
                                   source.texCoords[1], source.colors, source.indices}) {
    addNumber(hash, view == nullptr ? 0 : 1);
    if (view == nullptr) continue;
    std::string& accessor = accessors_[view];
    if (accessor.empty()) accessor = hashOf(*view);
    hash.add(std::string_view(accessor));
  }
  return hash.hex();
}

} // namespace gnomon
