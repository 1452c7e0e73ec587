#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/core/stop.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

namespace {

__extension__ using Wide = unsigned __int128; ///< holds every product of two 64-bit numbers

struct ElementShape {
  int components = 0;
  std::size_t bytes = 0; ///< the columns of a matrix start at multiples of 4 bytes (glTF 2.0, 3.6.2.4)
};

ElementShape shapeOf(ElementType type, ComponentType componentType) {
  const std::size_t component = bytesOf(componentType);
  if (type <= ElementType::vec4) {
    return {componentsOf(type), static_cast<std::size_t>(componentsOf(type)) * component};
  }
  const std::size_t side = 2 + static_cast<std::size_t>(type) - static_cast<std::size_t>(ElementType::mat2);
  return {0, (side * component + 3) / 4 * 4 * side};
}

/// A run of elements in a buffer view.
struct Run {
  int bufferView = 0;
  std::size_t offset = 0; ///< from the start of the buffer view
  std::size_t stride = 0;
  std::size_t count = 0; ///< > 0
  std::size_t elementBytes = 0;
  std::size_t alignment = 1;
};

constexpr const char* kLeftOut = "what needs it is left out";

/// The first element's bytes if all of the run lies inside its buffer view; nullptr, and a repair, if not.
const std::uint8_t* locate(const GltfDocument& document, const Run& run, const std::string& pointer,
                           Findings& findings) {
  const auto view = document.bufferViews[static_cast<std::size_t>(run.bufferView)];
  const Wide end = Wide{run.offset} + Wide{run.stride} * (run.count - 1) + run.elementBytes;
  if (end > view.size()) {
    findings.repair({"An accessor reaches past the end of its buffer view", kLeftOut}, pointer,
                    std::to_string(view.size()) + " bytes",
                    std::to_string(run.count) + " elements, " + std::to_string(run.stride) + " bytes apart, from " +
                        std::to_string(run.offset));
    return nullptr;
  }
  const std::size_t viewOffset = document.model.bufferViews[static_cast<std::size_t>(run.bufferView)].byteOffset;
  if ((viewOffset + run.offset) % run.alignment != 0 || run.stride % run.alignment != 0) {
    findings.repair({"An accessor is not aligned to the size of its components", "it is read where it is"}, pointer,
                    "a multiple of " + std::to_string(run.alignment) + " bytes",
                    "offset " + std::to_string(viewOffset + run.offset) + ", stride " + std::to_string(run.stride));
  }
  return view.data() + run.offset;
}

bool sparseIsOrdered(const AccessorView& view, const std::string& pointer, Findings& findings) {
  const std::size_t indexBytes = bytesOf(view.sparseIndexType);
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < view.sparseCount; ++i) {
    const std::int64_t index = unsignedAt(view.sparseIndices + i * indexBytes, view.sparseIndexType);
    if (index <= previous || static_cast<std::size_t>(index) >= view.count) {
      findings.repair({"Sparse indices are not increasing or reach past the accessor's count", kLeftOut}, pointer,
                      "below " + std::to_string(view.count), std::to_string(index));
      return false;
    }
    previous = index;
  }
  return true;
}

/// False, and a repair, where a rule is broken.
bool addSparse(const GltfDocument& document, const gltf::Accessor& accessor, std::size_t elementBytes,
               const std::string& pointer, AccessorView& view, Findings& findings) {
  const gltf::Sparse& sparse = *accessor.sparse;
  const std::size_t count = sparse.count;
  if (count > view.count) {
    findings.repair({"An accessor has more sparse values than elements", kLeftOut}, pointer + "/sparse/count",
                    std::to_string(view.count), std::to_string(count));
    return false;
  }
  view.sparseIndexType = sparse.indexType;
  const std::size_t indexBytes = bytesOf(view.sparseIndexType);
  view.sparseIndices =
      locate(document, {sparse.indexView, sparse.indexOffset, indexBytes, count, indexBytes, indexBytes},
             pointer + "/sparse/indices", findings);
  view.sparseValues = locate(
      document, {sparse.valueView, sparse.valueOffset, elementBytes, count, elementBytes, bytesOf(view.componentType)},
      pointer + "/sparse/values", findings);
  if (!view.sparseIndices || !view.sparseValues) return false;
  view.sparseCount = count;
  view.sparseStride = elementBytes;
  return sparseIsOrdered(view, pointer + "/sparse/indices", findings);
}

/// From one element to the next.
std::size_t strideOf(const gltf::BufferView& view, std::size_t elementBytes, const std::string& pointer,
                     Findings& findings) {
  const std::size_t stated = view.byteStride.value_or(0);
  if (stated != 0 && stated < elementBytes) {
    findings.repair({"A byteStride is smaller than an element", "the elements are read tightly packed"}, pointer,
                    ">= " + std::to_string(elementBytes), std::to_string(stated));
  }
  return stated < elementBytes ? elementBytes : stated;
}

AccessorView viewAccessor(const GltfDocument& document, const gltf::Accessor& accessor, const std::string& pointer,
                          Findings& findings) {
  if (accessor.faulty) return kFaultyAccessor;
  AccessorView view;
  view.componentType = accessor.componentType;
  view.normalized = accessor.normalized && view.componentType != ComponentType::float32;
  const ElementShape shape = shapeOf(accessor.type, view.componentType);
  view.components = shape.components;
  view.count = accessor.count;
  if (view.count == 0) {
    findings.repair({"An accessor has no elements", kLeftOut}, pointer);
    return kFaultyAccessor;
  }
  if (accessor.bufferView >= 0) {
    const gltf::BufferView& from = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    view.stride = strideOf(from, shape.bytes, pointer, findings);
    view.data = locate(
        document,
        {accessor.bufferView, accessor.byteOffset, view.stride, view.count, shape.bytes, bytesOf(view.componentType)},
        pointer, findings);
    if (!view.data) return kFaultyAccessor;
  }
  const bool sound = !accessor.sparse || addSparse(document, accessor, shape.bytes, pointer, view, findings);
  return sound ? view : kFaultyAccessor;
}

/// Of what is stated, and of the extent: numbers in JSON are rounded.
constexpr double kBoundsRounding = 1e-4;

/// Looked at, a vertex that may be.
constexpr std::size_t kMostElements = 8;

struct ElementExtent {
  glm::dvec4 least{HUGE_VAL};
  glm::dvec4 most{-HUGE_VAL};
  bool finite = true;
};

ElementExtent extentOfFloats(const AccessorView& view) {
  ElementExtent extent;
  for (std::size_t i = 0; i < view.count; ++i) {
    for (int c = 0; c < view.components; ++c) {
      float value = 0;
      std::memcpy(&value, view.data + i * view.stride + sizeof(float) * static_cast<std::size_t>(c), sizeof value);
      if (!std::isfinite(value)) extent.finite = false;
      extent.least[c] = std::min(extent.least[c], double{value});
      extent.most[c] = std::max(extent.most[c], double{value});
    }
  }
  return extent;
}

ElementExtent extentOf(AccessorView view) {
  if (view.componentType == ComponentType::float32 && view.sparseCount == 0) return extentOfFloats(view);
  view.normalized = false; // min and max are of the numbers as they are stored (glTF 2.0, accessor.normalized)
  ElementExtent extent;
  for (std::size_t i = 0; i < view.count; ++i) {
    const glm::dvec4 element = view.read(i);
    for (int c = 0; c < view.components; ++c) {
      if (!std::isfinite(element[c])) extent.finite = false;
    }
    extent.least = glm::min(extent.least, element);
    extent.most = glm::max(extent.most, element);
  }
  return extent;
}

bool isNear(double stated, double found, double extent) {
  return std::abs(stated - found) <= kBoundsRounding * std::max({std::abs(stated), std::abs(found), extent});
}

/// Whether what the file states of each component, if it states anything, is as the elements have it.
bool agree(const std::vector<double>& stated, const glm::dvec4& found, const ElementExtent& extent) {
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const auto c = static_cast<int>(i);
    if (!isNear(stated[i], found[c], extent.most[c] - extent.least[c])) return false;
  }
  return true;
}

} // namespace

std::vector<AccessorView> viewAccessors(const GltfDocument& document, const Limits& limits, Findings& findings) {
  std::vector<AccessorView> views;
  views.reserve(document.model.accessors.size());
  std::size_t sparseValues = 0;
  for (std::size_t i = 0; i < document.model.accessors.size(); ++i) {
    stopIfAsked();
    const gltf::Accessor& accessor = document.model.accessors[i];
    if (accessor.sparse) sparseValues += accessor.sparse->count;
    if (sparseValues > limits.maxVertices) { // each of them is looked at, so many accessors on few bytes cost time
      findings.tooLarge("/accessors", "The accessors have too many sparse values.", std::to_string(limits.maxVertices),
                        std::to_string(sparseValues));
      return {};
    }
    views.push_back(viewAccessor(document, accessor, pointerTo("/accessors", i), findings));
  }
  return views;
}

void checkContents(const LoadContext& load) {
  const std::vector<gltf::Accessor>& accessors = load.document.model.accessors;
  std::size_t elements = 0; // many accessors may lie on few bytes
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const gltf::Accessor& accessor = accessors[i];
    const AccessorView& view = load.accessors[i];
    const bool isFloat = view.componentType == ComponentType::float32;
    const bool states = !accessor.min.empty() || !accessor.max.empty();
    const bool hasElements = view.data != nullptr || view.sparseCount > 0; // else compressed, or all 0
    if (view.faulty || view.components == 0 || !hasElements || !(isFloat || states)) continue;
    stopIfAsked();
    if (view.count > kMostElements * load.limits.maxVertices - elements) {
      load.findings.warn("The accessors have too many elements for all to be checked.");
      return;
    }
    elements += view.count;
    const std::string pointer = pointerTo("/accessors", i);
    const ElementExtent extent = extentOf(view);
    const auto components = static_cast<std::size_t>(view.components);
    if (!extent.finite) {
      load.findings.repair({"An accessor has numbers that are not finite", "they are not used"}, pointer);
    } else if (accessor.min.size() > components || accessor.max.size() > components ||
               !agree(accessor.min, extent.least, extent) || !agree(accessor.max, extent.most, extent)) {
      load.findings.repair({"The min and max of an accessor are not those of its elements", "they are not used"},
                           pointer);
    }
  }
}

} // namespace gnomon
