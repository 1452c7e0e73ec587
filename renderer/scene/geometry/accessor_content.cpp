#include "renderer/scene/geometry/accessor_content.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/core/stop.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

namespace {

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
