#include "renderer/resolve/resolve_variant.h"

#include <algorithm>
#include <string_view>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

std::string namesOf(const std::vector<std::string>& variants) {
  if (variants.empty()) return "the file has no material variants";
  return oneOf(std::vector<std::string_view>(variants.begin(), variants.end()));
}

} // namespace

Result<int> resolveVariant(const std::string& name, const Scene& scene) {
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), name);
  if (found != scene.variants.end()) return static_cast<int>(found - scene.variants.begin());
  return Problem{ProblemCode::invalidValue, "/materialVariant", "The file has no material variant of that name.",
                 namesOf(scene.variants), name};
}

} // namespace gnomon
