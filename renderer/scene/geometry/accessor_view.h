#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/document/gltf_model.h"

namespace gnomon {

class Findings;
struct GltfDocument;
struct Limits;
struct LoadContext;

std::size_t bytesOf(ComponentType type);

/// Of a scalar or a vector; 0 for matrices.
int componentsOf(ElementType type);

/// A little-endian unsigned integer; `type` must be one of the unsigned types.
std::uint32_t unsignedAt(const std::uint8_t* bytes, ComponentType type);

/// An accessor whose ranges have been checked; sparse values are found by binary search.
struct AccessorView {
  const std::uint8_t* data = nullptr; ///< of the first element; nullptr = all zero
  std::size_t count = 0;
  std::size_t stride = 0; ///< bytes
  int components = 1;     ///< 1..4; 0 for matrices
  ComponentType componentType = ComponentType::float32;
  bool normalized = false;

  bool faulty = false; ///< it can't be read: nothing else of it means anything

  std::size_t sparseCount = 0;
  const std::uint8_t* sparseIndices = nullptr; ///< packed, strictly increasing
  ComponentType sparseIndexType = ComponentType::uint32;
  const std::uint8_t* sparseValues = nullptr; ///< packed
  std::size_t sparseStride = 0;               ///< bytes of one of them

  /// REQUIRES: element < count, components > 0. Components that the accessor does not have stay as in `missing`.
  glm::dvec4 read(std::size_t element, glm::dvec4 missing = glm::dvec4(0)) const;

  /// REQUIRES: element < count, MAT4 of floats.
  glm::dmat4 readMatrix(std::size_t element) const;

  /// REQUIRES: element < count, one unsigned component.
  std::uint32_t readIndex(std::size_t element) const;

 private:
  const std::uint8_t* bytesOfElement(std::size_t element) const {
    if (const std::uint8_t* own = sparseCount == 0 ? nullptr : sparseBytes(element)) return own;
    return data ? data + element * stride : nullptr;
  }
  const std::uint8_t* sparseBytes(std::size_t element) const; ///< null: it is not among the sparse ones
};

/// Of no use to any reader: it has no elements, and its type is none that is read.
inline constexpr AccessorView kFaultyAccessor{.components = 0, .faulty = true};

/// A view of each accessor; kFaultyAccessor, and a repair, of those that can't be read.
std::vector<AccessorView> viewAccessors(const GltfDocument& document, const Limits& limits, Findings& findings);

/// Reports accessors with floats that are not finite or with a wrong min or max, also those that nothing uses.
void checkContents(const LoadContext& load);

} // namespace gnomon
