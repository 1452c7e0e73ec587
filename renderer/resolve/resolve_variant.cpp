#include "renderer/resolve/resolve_variant.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t kVariantsNamed = 20;

std::string namesOf(const std::vector<std::string>& variants) {
  if (variants.empty()) return "the file has no material variants";
  std::string names = "one of ";
  for (std::size_t i = 0; i < std::min(variants.size(), kVariantsNamed); ++i)
    names += (i == 0 ? "" : ", ") + variants[i];
  if (variants.size() > kVariantsNamed) names += " and " + std::to_string(variants.size() - kVariantsNamed) + " more";
  return names;
}

} // namespace

Result<int> resolveVariant(const std::string& name, const Scene& scene) {
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), name);
  if (found != scene.variants.end()) return static_cast<int>(found - scene.variants.begin());
  return Problem{ProblemCode::invalidValue, "/materialVariant", "The file has no material variant of that name.",
                 namesOf(scene.variants), name};
}

} // namespace gnomon
