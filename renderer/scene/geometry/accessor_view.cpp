#include "renderer/scene/geometry/accessor_view.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace gnomon {

namespace {

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// glTF 2.0, 3.6.2.2: an integer of a normalized accessor as a number in 0..1 or -1..1.
template <class T>
double numberAt(const std::uint8_t* bytes, bool normalized) {
  const double value = static_cast<double>(load<T>(bytes));
  return normalized ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
}

double componentAt(const std::uint8_t* bytes, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::int8:
      return numberAt<std::int8_t>(bytes, normalized);
    case ComponentType::uint8:
      return numberAt<std::uint8_t>(bytes, normalized);
    case ComponentType::int16:
      return numberAt<std::int16_t>(bytes, normalized);
    case ComponentType::uint16:
      return numberAt<std::uint16_t>(bytes, normalized);
    case ComponentType::uint32:
      return numberAt<std::uint32_t>(bytes, normalized);
    case ComponentType::float32:
      return static_cast<double>(load<float>(bytes));
  }
  return 0;
}

} // namespace

std::uint32_t unsignedAt(const std::uint8_t* bytes, ComponentType type) {
  switch (type) {
    case ComponentType::uint8:
      return load<std::uint8_t>(bytes);
    case ComponentType::uint16:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

std::size_t bytesOf(ComponentType type) {
  return type <= ComponentType::uint8 ? 1 : type <= ComponentType::uint16 ? 2 : 4;
}

int componentsOf(ElementType type) {
  return type <= ElementType::vec4 ? static_cast<int>(type) + 1 : 0;
}

const std::uint8_t* AccessorView::sparseBytes(std::size_t element) const {
  const std::size_t indexBytes = bytesOf(sparseIndexType);
  std::size_t first = 0;
  std::size_t last = sparseCount;
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    const std::uint32_t index = unsignedAt(sparseIndices + middle * indexBytes, sparseIndexType);
    if (index == element) return sparseValues + middle * sparseStride;
    if (index < element) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return nullptr;
}

glm::dvec4 AccessorView::read(std::size_t element, glm::dvec4 missing) const {
  assert(element < count && components > 0);
  const std::uint8_t* bytes = bytesOfElement(element);
  if (bytes && componentType == ComponentType::float32) { // nearly all
    for (int i = 0; i < components; ++i) missing[i] = load<float>(bytes + sizeof(float) * static_cast<std::size_t>(i));
    return missing;
  }
  const std::size_t step = bytesOf(componentType);
  for (int i = 0; i < components; ++i) {
    missing[i] = bytes ? componentAt(bytes + static_cast<std::size_t>(i) * step, componentType, normalized) : 0.0;
  }
  return missing;
}

glm::dmat4 AccessorView::readMatrix(std::size_t element) const {
  assert(element < count && components == 0 && componentType == ComponentType::float32);
  const std::uint8_t* bytes = bytesOfElement(element);
  glm::dmat4 matrix(0);
  for (int i = 0; i < 16 && bytes; ++i) {
    matrix[i / 4][i % 4] = componentAt(bytes + sizeof(float) * static_cast<std::size_t>(i), componentType, false);
  }
  return matrix;
}

std::uint32_t AccessorView::readIndex(std::size_t element) const {
  assert(element < count && components == 1);
  const std::uint8_t* bytes = bytesOfElement(element);
  return bytes ? unsignedAt(bytes, componentType) : 0;
}

} // namespace gnomon
