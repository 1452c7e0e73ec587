#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

/// What every light's shadow is given.
struct ShadowVariant {
  std::string name;
  Json shadow;
};

Json filterPatch(FilterType type, std::optional<int> size) {
  Json filter = {{"type", std::string(spell(type))}, {"size", nullptr}, {"radius", nullptr}};
  if (size) filter["size"] = *size;
  return filter;
}

ShadowVariant filtered(FilterType type, std::optional<int> size = std::nullopt) {
  const Json shadow = {{"technique", "shadowMap"}, {"filter", filterPatch(type, size)}};
  return {std::string(spell(type)) + (size ? " " + std::to_string(*size) : ""), shadow};
}

void appendTechniques(std::vector<ShadowVariant>& variants) {
  variants.push_back(filtered(FilterType::hard));
  variants.push_back(filtered(FilterType::pcf, 3));
  variants.push_back(filtered(FilterType::pcf, 5));
  variants.push_back(filtered(FilterType::pcss));
  for (const TechniqueTraits& technique : kTechniqueTraits) {
    const std::string name(spell(technique.technique));
    if (technique.layered) variants.push_back({name, {{"technique", name}}});
  }
  variants.push_back({"auto", {{"technique", "auto"}, {"filter", nullptr}, {"bias", nullptr}}});
}

void appendFilters(std::vector<ShadowVariant>& variants) {
  for (const Spelling& spelling : kSpellings<FilterType>) {
    const auto type = static_cast<FilterType>(spelling.value);
    if (type == FilterType::hard || type == FilterType::pcss) {
      variants.push_back(filtered(type));
      continue;
    }
    for (const int size : {3, 5, 7}) variants.push_back(filtered(type, size));
  }
}

void appendSizes(std::vector<ShadowVariant>& variants) {
  for (const int cascades : {1, 2, 4}) {
    for (const Spelling& size : kSpellings<ShadowSize>) {
      ShadowVariant variant = filtered(FilterType::hard);
      variant.name = "hard " + std::to_string(cascades) + " x " + std::string(size.name);
      variant.shadow["size"] = std::string(size.name);
      variant.shadow["cascadeCount"] = cascades;
      variant.shadow["partition"] = {{"mode", "logarithmic"}, {"splits", nullptr}};
      variants.push_back(std::move(variant));
    }
  }
}

/// A light's own shadow overrides the frame's, so it is changed, too; a list can only be replaced as a whole.
Json patchOf(const Json& shadow, const Json& spec) {
  Json patch = {{"shadow", shadow}};
  const auto lights = spec.find("lights");
  if (lights == spec.end() || !lights->is_array()) return patch;
  const auto hasOwn = [](const Json& light) { return light.is_object() && light.contains("shadow"); };
  if (std::none_of(lights->begin(), lights->end(), hasOwn)) return patch;
  patch["lights"] = *lights;
  for (Json& light : patch["lights"]) {
    if (hasOwn(light)) light["shadow"].merge_patch(shadow);
  }
  return patch;
}

/// "shadow" goes without saying.
std::string shownPath(const std::string& path) {
  constexpr std::string_view kUsual = "shadow.";
  return path.starts_with(kUsual) ? path.substr(kUsual.size()) : path;
}

std::string shownValue(const Json& value) {
  if (value.is_null()) return "left out";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array() && !value.empty() && value[0].is_object()) return "of " + std::to_string(value.size());
  return value.dump();
}

void appendChanges(const Json& patch, const std::string& path, std::string& text) {
  for (const auto& [key, value] : patch.items()) {
    const std::string inner = path.empty() ? key : path + "." + key;
    if (value.is_object() && !value.empty()) {
      appendChanges(value, inner, text);
    } else {
      text += (text.empty() ? "" : ", ") + shownPath(inner) + " " + shownValue(value);
    }
  }
}

} // namespace

std::vector<SweepVariant> sweepVariants(Sweep sweep, const Json& spec) {
  std::vector<ShadowVariant> shadows;
  if (sweep == Sweep::techniques || sweep == Sweep::all) appendTechniques(shadows);
  if (sweep == Sweep::filters || sweep == Sweep::all) appendFilters(shadows);
  if (sweep == Sweep::sizes || sweep == Sweep::all) appendSizes(shadows);
  std::vector<SweepVariant> variants;
  for (const ShadowVariant& shadow : shadows) {
    const auto same = [&](const SweepVariant& other) { return other.name == shadow.name; };
    if (std::any_of(variants.begin(), variants.end(), same)) continue;
    variants.push_back({shadow.name, patchOf(shadow.shadow, spec)});
  }
  return variants;
}

std::string variantName(const Json& patch) {
  constexpr std::size_t kMaxBytes = 80;
  std::string text;
  appendChanges(patch, "", text);
  return text.empty() ? "as given" : shortened(text, kMaxBytes);
}

} // namespace gnomon
