#include "renderer/passes/shader_variants.h"

#include <array>
#include <cctype>

#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

/// How a texture is read, at coordinates `uv` of a vertex, moved by the transform of its unit.
struct TextureReading {
  std::string name, uv, unit;
  bool moved;

  std::string of(const std::string& function, const std::string& before, const std::string& still) const {
    return moved ? function + "(" + before + uv + ", " + unit + ")" : still;
  }
  std::string texture() const { return name + "_TEXTURE"; }
  std::string texel() const { return name + "_TEXEL(map) " + of("movedTexel", "map, ", "texture(map, " + uv + ")"); }
  std::string place() const { return name + "_PLACE " + of("movedPlace", "", uv); }
  /// How far the coordinates go in a step.
  std::string step() const {
    const std::string still = "derivative(" + uv + ")";
    return name + "_STEP(derivative) " + (moved ? "movedStep(" + still + ", " + unit + ")" : still);
  }
};

/// VIEW_ and the view's name in capitals: texelGrid is VIEW_TEXEL_GRID.
std::string viewDefine(View view) {
  std::string define = "VIEW_";
  for (const char letter : spell(view)) {
    if (letter >= 'A' && letter <= 'Z') define += '_';
    define += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return define;
}

void addShadowDefines(const ShadowSampling& shadows, std::vector<std::string>& defines) {
  if (shadows.kinds.empty()) {
    defines.emplace_back("NO_SHADOWS");
    return;
  }
  if (shadows.kinds.size() == 1) defines.push_back("FILTER_KIND " + std::to_string(*shadows.kinds.begin()));
  if (shadows.texels.size() == 1) defines.push_back("FILTER_SIZE " + std::to_string(*shadows.texels.begin()));
  if (shadows.kinds.contains(GNOMON_FILTER_DISC)) defines.emplace_back("FILTER_DISC");
  if (shadows.kinds.contains(GNOMON_FILTER_PCSS)) defines.emplace_back("FILTER_PCSS");
  if (shadows.moments) defines.emplace_back("FILTER_MOMENTS");
  if (shadows.manualBias) defines.emplace_back("MANUAL_BIAS");
  if (shadows.atlasSamples > 1) defines.push_back("ATLAS_SAMPLES " + std::to_string(shadows.atlasSamples));
}

} // namespace

std::vector<std::string> maskDefines(const Material* material) {
  if (material == nullptr) return {};
  std::vector<std::string> defines{"ALPHA_MASK"};
  if (!hasHoles(*material)) return defines;
  if (material->hasVertexColors) defines.emplace_back("VERTEX_COLORS");
  if (material->baseColor) {
    defines.emplace_back("BASE_COLOR_TEXTURE");
    if (material->baseColor->texCoord == 1) defines.emplace_back("BASE_COLOR_UV1");
    if (material->baseColor->transform) defines.emplace_back("TEXTURE_TRANSFORM");
  }
  return defines;
}

gl::ProgramSource depthProgram(std::string vertexShader, const Material* masked) {
  return {std::move(vertexShader), masked != nullptr ? "masked_depth.frag" : "", maskDefines(masked)};
}

gl::ProgramSource castProgram(const Material* masked, BlendedCasters blended) {
  gl::ProgramSource source = depthProgram("shadow_cast.vert", masked);
  if (masked == nullptr) return source;
  source.defines.emplace_back("SEEN_BY_LIGHT");
  if (masked->lightOpacity && blended == BlendedCasters::dither) source.defines.emplace_back("ALPHA_DITHER");
  return source;
}

gl::ProgramSource casterNodeProgram(const Material* masked, BlendedCasters blended) {
  gl::ProgramSource source = castProgram(masked, blended);
  source.fragment = "masked_depth.frag";
  source.defines.emplace_back("CASTER_NODE");
  return source;
}

gl::ProgramSource surfaceProgram(const Material& material, const SurfaceVariant& variant) {
  struct Slot {
    const std::optional<TextureUse>* use;
    const char* name;
  };
  const std::array<Slot, 5> slots{{{&material.baseColor, "BASE_COLOR"},
                                   {&material.metallicRoughness, "METALLIC_ROUGHNESS"},
                                   {&material.normal, "NORMAL"},
                                   {&material.occlusion, "OCCLUSION"},
                                   {&material.emissive, "EMISSIVE"}}};
  std::vector<std::string> defines;
  std::array<bool, 2> uvs{};
  bool moved = false;
  const bool masked = hasHoles(material);
  for (std::size_t unit = 0; unit < slots.size(); ++unit) {
    const Slot& slot = slots[unit];
    if (!*slot.use) continue;
    const TextureUse& use = **slot.use;
    moved = moved || use.transform;
    const TextureReading reading{slot.name, use.texCoord == 0 ? "surface.uv0" : "surface.uv1", std::to_string(unit),
                                 use.transform.has_value()};
    defines.push_back(reading.texture());
    defines.push_back(reading.texel());
    const bool isHoled = slot.use == &material.baseColor && masked;
    if (isHoled || slot.use == &material.normal) defines.push_back(reading.step());
    if (isHoled) defines.push_back(reading.place());
    uvs[use.texCoord == 0 ? 0 : 1] = true;
  }
  if (moved) defines.emplace_back("TEXTURE_TRANSFORM");
  if (uvs[0]) defines.emplace_back("UV0");
  if (uvs[1]) defines.emplace_back("UV1");
  if (material.hasVertexColors) defines.emplace_back("VERTEX_COLORS");
  if (variant.tangents) defines.emplace_back("TANGENTS");
  if (material.doubleSided) defines.emplace_back("DOUBLE_SIDED");
  if (masked) defines.emplace_back("ALPHA_MASK");
  if (material.specularGlossiness) defines.emplace_back("SPECULAR_GLOSSINESS");
  if (material.unlit) defines.emplace_back("UNLIT");
  if (material.transmission > 0) {
    defines.emplace_back("TRANSMISSION");
    if (variant.environment) defines.emplace_back("ENVIRONMENT");
  }
  if (variant.emission) defines.emplace_back("EMISSION");
  if (variant.receiverGroups) defines.emplace_back("RECEIVER_GROUPS");
  int location = variant.emission ? 2 : 1;
  if (variant.smoothPlaces) defines.push_back("SMOOTH_PLACES " + std::to_string(location++));
  if (variant.bakedLights > 0) {
    defines.push_back("BAKED_LIGHTS " + std::to_string(variant.bakedLights));
    defines.push_back("BAKED_SHARES " + std::to_string(location++));
    if (variant.shownSamples > 0) defines.push_back("SHOWN_SAMPLES " + std::to_string(variant.shownSamples));
  }
  if (variant.numbered) defines.push_back("TRIANGLE_NUMBERS " + std::to_string(location));
  return {"surface.vert", "surface.frag", std::move(defines)};
}

gl::ProgramSource viewProgram(const ViewVariant& variant) {
  std::vector<std::string> defines{viewDefine(variant.view)};
  defines.push_back("SAMPLES " + std::to_string(variant.samples));
  if (variant.lightLists) {
    defines.emplace_back("LIGHT_LISTS");
  } else if (variant.lights > 0) {
    defines.push_back("LIGHT_COUNT " + std::to_string(variant.lights));
  }
  if (variant.tiles > 0) defines.push_back("TILE_COUNT " + std::to_string(variant.tiles));
  if (variant.punctual) defines.emplace_back("PUNCTUAL");
  addShadowDefines(variant.shadows, defines);
  if (variant.smoothPlaces) defines.emplace_back("SMOOTH_PLACES");
  if (variant.visibilityLayers) defines.emplace_back("VISIBILITY_LAYERS");
  if (variant.bakedLights > 0) {
    defines.push_back("BAKED_LIGHTS " + std::to_string(variant.bakedLights));
    defines.push_back("FIRST_BAKED " + std::to_string(variant.firstBaked) + "u");
  }
  if (variant.shadowColor) defines.emplace_back("SHADOW_COLOR");
  if (variant.volumes) defines.emplace_back("VOLUMES");
  if (variant.volumeLight >= 0) defines.push_back("VOLUME_LIGHT " + std::to_string(variant.volumeLight));
  if (variant.environment) defines.emplace_back("ENVIRONMENT");
  if (variant.shownSurroundings) defines.emplace_back("SHOWN_SURROUNDINGS");
  if (variant.emission) defines.emplace_back("EMISSION");
  if (variant.unlit) defines.emplace_back("UNLIT");
  if (variant.receiverGroups) defines.emplace_back("RECEIVER_GROUPS");
  if (traitsOf(variant.view).oneLight) defines.emplace_back("DEBUG_LIGHT");
  if (variant.encoded) defines.emplace_back("ENCODED");
  if (variant.tone != GNOMON_TONE_NONE) defines.push_back("TONE " + std::to_string(variant.tone));
  return {"fullscreen.vert", "view.frag", std::move(defines)};
}

gl::ProgramSource probeProgram(const ViewVariant& variant) {
  std::vector<std::string> defines;
  if (variant.tiles > 0) defines.push_back("TILE_COUNT " + std::to_string(variant.tiles));
  if (variant.punctual) defines.emplace_back("PUNCTUAL");
  addShadowDefines(variant.shadows, defines);
  if (variant.receiverGroups) defines.emplace_back("RECEIVER_GROUPS");
  return {"fullscreen.vert", "probe.frag", std::move(defines)};
}

gl::ProgramSource displacementProgram(const ViewVariant& variant) {
  gl::ProgramSource source = probeProgram(variant);
  source.fragment = "displacement.frag";
  if (variant.smoothPlaces) source.defines.emplace_back("SMOOTH_PLACES");
  return source;
}

} // namespace gnomon
