#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "renderer/scene/checks/gltf_schema.h"

namespace gnomon {

namespace {

constexpr std::string_view kSupported[] = {"CESIUM_RTC",
                                           "EXT_lights_image_based",
                                           "EXT_mesh_gpu_instancing",
                                           "EXT_meshopt_compression",
                                           "EXT_texture_webp",
                                           "KHR_animation_pointer",
                                           "KHR_draco_mesh_compression",
                                           "KHR_lights_punctual",
                                           "KHR_materials_emissive_strength",
                                           "KHR_materials_pbrSpecularGlossiness",
                                           "KHR_materials_transmission",
                                           "KHR_materials_unlit",
                                           "KHR_materials_variants",
                                           "KHR_mesh_quantization",
                                           "KHR_meshopt_compression",
                                           "KHR_node_visibility",
                                           "KHR_texture_transform"};

/// Metadata, which changes no pixel.
constexpr std::string_view kMetadata[] = {"AGI_articulations",
                                          "AGI_stk_metadata",
                                          "EXT_feature_metadata",
                                          "EXT_instance_features",
                                          "EXT_mesh_features",
                                          "EXT_structural_metadata",
                                          "KHR_audio_emitter",
                                          "KHR_interactivity",
                                          "KHR_node_hoverability",
                                          "KHR_node_selectability",
                                          "KHR_physics_rigid_bodies",
                                          "KHR_implicit_shapes",
                                          "KHR_xmp",
                                          "KHR_xmp_json_ld"};

struct Consequence {
  std::string_view extension;
  std::string_view drawn;
};

/// What happens to a file that uses an extension, and can be drawn without it.
constexpr std::array kConsequences{
    Consequence{"KHR_materials_anisotropy", "highlights are as wide along the surface as across it"},
    Consequence{"KHR_materials_clearcoat", "surfaces have no clear coat"},
    Consequence{"KHR_materials_dispersion", "all colors are refracted equally"},
    Consequence{"KHR_materials_ior", "the index of refraction is 1.5"},
    Consequence{"KHR_materials_iridescence", "surfaces have no thin film"},
    Consequence{"KHR_materials_sheen", "surfaces have no sheen"},
    Consequence{"KHR_materials_specular", "reflections of dielectrics are neither weakened nor tinted"},
    Consequence{"KHR_materials_volume", "surfaces are thin: nothing is refracted or absorbed inside"},
    Consequence{"KHR_texture_basisu", "the fallback image is used"},
};

bool isMetadata(std::string_view name) {
  return std::ranges::find(kMetadata, name) != std::end(kMetadata);
}

/// Whether a file that requires the extension is drawn without it.
bool isNoObstacle(std::string_view name) {
  return isMetadata(name) || name.starts_with("KHR_materials_");
}

std::string_view consequenceOf(std::string_view name) {
  for (const Consequence& row : kConsequences) {
    if (row.extension == name) return row.drawn;
  }
  return isMetadata(name) ? "it changes no pixel" : "its additions are not drawn";
}

/// With their places in it.
std::vector<std::pair<std::size_t, std::string>> stringsIn(const nlohmann::json& document, const char* key) {
  std::vector<std::pair<std::size_t, std::string>> names;
  const auto member = document.find(key);
  if (member == document.end() || !member->is_array()) return names;
  for (std::size_t i = 0; i < member->size(); ++i) {
    if ((*member)[i].is_string()) names.emplace_back(i, (*member)[i].get<std::string>());
  }
  return names;
}

const std::string* assetMember(const nlohmann::json& document, const char* key) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object()) return nullptr;
  const auto value = asset->find(key);
  return value == asset->end() ? nullptr : value->get_ptr<const std::string*>();
}

} // namespace

void checkVersion(const nlohmann::json& document, Findings& findings) {
  const std::string* version = assetMember(document, "version");
  if (!version) {
    findings.invalid("/asset/version", "The glTF does not state its version.", "2.x");
  } else if (!version->starts_with("2.")) {
    findings.refuse(
        {ProblemCode::unsupportedFeature, "/asset/version", "Only glTF 2 is supported.", "2.x", inQuotes(*version)});
  }
  const std::string* minVersion = assetMember(document, "minVersion");
  if (minVersion && *minVersion != "2.0") {
    findings.refuse({ProblemCode::unsupportedFeature, "/asset/minVersion", "The glTF requires a newer version of glTF.",
                     "2.0", inQuotes(*minVersion)});
  }
}

std::set<std::string> namesIn(const nlohmann::json& document, const char* key) {
  std::set<std::string> names;
  for (auto& [index, name] : stringsIn(document, key)) names.insert(std::move(name));
  return names;
}

bool isSupported(std::string_view extension) {
  return std::ranges::find(kSupported, extension) != std::end(kSupported);
}

void checkExtensions(const nlohmann::json& document, Findings& findings) {
  const std::set<std::string> used = namesIn(document, "extensionsUsed");
  std::set<std::string> reported;
  for (const auto& [index, name] : stringsIn(document, "extensionsRequired")) {
    const std::string pointer = pointerTo("/extensionsRequired", index);
    if (isSupported(name)) {
      if (used.contains(name)) continue;
      findings.repair({"An extension is required and not listed in `extensionsUsed`", "it is read"}, pointer, {},
                      inQuotes(name));
    } else if (isNoObstacle(name)) {
      findings.repair({"The glTF requires the extension " + inQuotes(name) + ", which is not supported",
                       std::string(consequenceOf(name))},
                      pointer);
      reported.insert(name);
    } else {
      findings.unsupported(pointer, "The glTF requires the extension " + inQuotes(name) + ", which is not supported.");
    }
  }
  for (const auto& [index, name] : stringsIn(document, "extensionsUsed")) {
    if (!isSupported(name) && !reported.contains(name)) {
      findings.warn("The extension " + inQuotes(name) + " is not supported: " + std::string(consequenceOf(name)) + ".");
    }
  }
}

std::vector<std::string> unsupportedOf(const std::vector<std::string>& names) {
  std::vector<std::string> left;
  std::copy_if(names.begin(), names.end(), std::back_inserter(left),
               [](const auto& name) { return !isSupported(name); });
  return left;
}

} // namespace gnomon
