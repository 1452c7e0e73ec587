#include "renderer/scene/checks/gltf_fields.h"

#include <numbers>

namespace gnomon {

namespace {

using enum FieldKind;

constexpr double kMaxOffset = 9007199254740991.0; // 2^53 - 1: the largest count that JSON numbers hold exactly
constexpr double kMaxSparse = 2147483647.0;
constexpr double kMaxTexCoord = 255;
constexpr double kMaxUv = 1e9; // beyond what floats resolve in a texture
constexpr double kMaxAttributeId = 4294967295.0;

/// A member with one of these values, separated by spaces.
constexpr GltfField oneOf(std::string_view owner, std::string_view key, FieldKind kind, std::string_view allowed,
                          bool required = false) {
  return {.owner = owner, .key = key, .kind = kind, .required = required, .allowed = allowed};
}

/// The same, whose other values have no default.
constexpr GltfField strictlyOneOf(std::string_view owner, std::string_view key, std::string_view allowed) {
  return {.owner = owner, .key = key, .kind = string, .allowed = allowed, .noDefault = true};
}

/// A number above 0.
constexpr GltfField above0(std::string_view owner, std::string_view key, bool required,
                           double max = std::numeric_limits<double>::infinity()) {
  return {.owner = owner, .key = key, .kind = number, .required = required, .min = 0, .max = max, .minExcluded = true};
}

constexpr GltfField kFields[] = {
    {"root", "asset", object, "asset", true},
    {"root", "extensionsUsed", strings},
    {"root", "extensionsRequired", strings},
    {"root", "extensions", object, "root.extensions"},
    {"root", "scene", reference, "scenes"},
    {"root", "scenes", objects, "scene"},
    {"root", "nodes", objects, "node"},
    {"root", "meshes", objects, "mesh"},
    {"root", "accessors", objects, "accessor"},
    {"root", "bufferViews", objects, "bufferView"},
    {"root", "buffers", objects, "buffer"},
    {"root", "materials", objects, "material"},
    {"root", "textures", objects, "texture"},
    {"root", "samplers", objects, "sampler"},
    {"root", "images", objects, "image"},
    {"root", "cameras", objects, "camera"},
    {"root", "skins", objects, "skin"},
    {"root", "animations", objects, "animation"},

    {"asset", "version", string, {}, true},
    {"root.extensions", "KHR_lights_punctual", object, "lights"},
    {"root.extensions", "EXT_lights_image_based", object, "imageBasedLights"},
    {"root.extensions", "KHR_materials_variants", object, "variants"},
    {"root.extensions", "CESIUM_RTC", object, "rtc"},
    {.owner = "rtc", .key = "center", .kind = numbers, .required = true, .length = 3},
    {"variants", "variants", objects, "variant", true},
    {"variant", "name", string, {}, true},

    {"scene", "name", string},
    {"scene", "nodes", references, "nodes"},
    {"scene", "extensions", object, "scene.extensions"},
    {"scene.extensions", "EXT_lights_image_based", object, "scene.light"},
    {"scene.light", "light", reference, "imageBasedLights", true},

    {"node", "name", string},
    {"node", "children", references, "nodes"},
    {"node", "mesh", reference, "meshes"},
    {"node", "camera", reference, "cameras"},
    {"node", "skin", reference, "skins"},
    {.owner = "node", .key = "matrix", .kind = numbers, .length = 16},
    {.owner = "node", .key = "translation", .kind = numbers, .length = 3},
    {.owner = "node", .key = "rotation", .kind = numbers, .length = 4},
    {.owner = "node", .key = "scale", .kind = numbers, .length = 3},
    {"node", "weights", numbers},
    {"node", "extensions", object, "node.extensions"},
    {"node.extensions", "KHR_lights_punctual", object, "node.light"},
    {"node.extensions", "EXT_mesh_gpu_instancing", object, "instancing"},
    {"instancing", "attributes", referenceMap, "accessors", true},
    {"node.extensions", "KHR_node_visibility", object, "visibility"},
    {"visibility", "visible", boolean},
    {"node.light", "light", reference, "lights", true},

    {"mesh", "name", string},
    {"mesh", "primitives", objects, "primitive", true},
    {"mesh", "weights", numbers},
    {"primitive", "attributes", referenceMap, "accessors", true},
    {"primitive", "indices", reference, "accessors"},
    {"primitive", "material", reference, "materials"},
    oneOf("primitive", "mode", integer, "0 1 2 3 4 5 6"),
    {"primitive", "targets", referenceMaps, "accessors"},
    {"primitive", "extensions", object, "primitive.extensions"},
    {"primitive.extensions", "KHR_draco_mesh_compression", object, "draco"},
    {"primitive.extensions", "KHR_materials_variants", object, "variantMappings"},
    {"variantMappings", "mappings", objects, "variantMapping", true},
    {"variantMapping", "material", reference, "materials", true},
    {"variantMapping", "variants", references, "variants", true},
    {"draco", "bufferView", reference, "bufferViews", true},
    {.owner = "draco", .key = "attributes", .kind = integerMap, .required = true, .min = 0, .max = kMaxAttributeId},

    {"accessor", "bufferView", reference, "bufferViews"},
    {.owner = "accessor", .key = "byteOffset", .kind = integer, .min = 0, .max = kMaxOffset},
    oneOf("accessor", "componentType", integer, "5120 5121 5122 5123 5125 5126", true),
    {"accessor", "normalized", boolean},
    {.owner = "accessor", .key = "count", .kind = integer, .required = true, .min = 0, .max = kMaxOffset},
    oneOf("accessor", "type", string, "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4", true),
    {"accessor", "min", numbers},
    {"accessor", "max", numbers},
    {"accessor", "sparse", object, "sparse"},
    {.owner = "sparse", .key = "count", .kind = integer, .required = true, .min = 1, .max = kMaxSparse},
    {"sparse", "indices", object, "sparse.indices", true},
    {"sparse", "values", object, "sparse.values", true},
    {"sparse.indices", "bufferView", reference, "bufferViews", true},
    {.owner = "sparse.indices", .key = "byteOffset", .kind = integer, .min = 0, .max = kMaxSparse},
    oneOf("sparse.indices", "componentType", integer, "5121 5123 5125", true),
    {"sparse.values", "bufferView", reference, "bufferViews", true},
    {.owner = "sparse.values", .key = "byteOffset", .kind = integer, .min = 0, .max = kMaxSparse},

    {"bufferView", "buffer", reference, "buffers", true},
    {.owner = "bufferView", .key = "byteOffset", .kind = integer, .min = 0, .max = kMaxOffset},
    {.owner = "bufferView", .key = "byteLength", .kind = integer, .required = true, .min = 1, .max = kMaxOffset},
    {.owner = "bufferView", .key = "byteStride", .kind = integer, .min = 0, .max = kMaxOffset},
    {"bufferView", "extensions", object, "bufferView.extensions"},
    {"bufferView.extensions", "EXT_meshopt_compression", object, "meshopt"},
    {"bufferView.extensions", "KHR_meshopt_compression", object, "meshopt"},
    {"meshopt", "buffer", reference, "buffers", true},
    {.owner = "meshopt", .key = "byteOffset", .kind = integer, .min = 0, .max = kMaxOffset},
    {.owner = "meshopt", .key = "byteLength", .kind = integer, .required = true, .min = 1, .max = kMaxOffset},
    {.owner = "meshopt", .key = "byteStride", .kind = integer, .required = true, .min = 1, .max = 256},
    {.owner = "meshopt", .key = "count", .kind = integer, .required = true, .min = 1, .max = kMaxOffset},
    oneOf("meshopt", "mode", string, "ATTRIBUTES TRIANGLES INDICES", true),
    strictlyOneOf("meshopt", "filter", "NONE OCTAHEDRAL QUATERNION EXPONENTIAL COLOR"),
    {"buffer", "extensions", object, "buffer.extensions"},
    {"buffer.extensions", "EXT_meshopt_compression", object, "meshopt.buffer"},
    {"buffer.extensions", "KHR_meshopt_compression", object, "meshopt.buffer"},
    {"meshopt.buffer", "fallback", boolean},
    {"buffer", "uri", string},
    {.owner = "buffer", .key = "byteLength", .kind = integer, .required = true, .min = 1, .max = kMaxOffset},

    {"material", "name", string},
    {"material", "pbrMetallicRoughness", object, "pbr"},
    {"material", "normalTexture", object, "normalTexture"},
    {"material", "occlusionTexture", object, "occlusionTexture"},
    {"material", "emissiveTexture", object, "textureInfo"},
    {.owner = "material", .key = "emissiveFactor", .kind = numbers, .min = 0, .length = 3},
    oneOf("material", "alphaMode", string, "OPAQUE MASK BLEND"),
    {.owner = "material", .key = "alphaCutoff", .kind = number, .min = 0},
    {"material", "doubleSided", boolean},
    {"material", "extensions", object, "material.extensions"},
    {"material.extensions", "KHR_materials_emissive_strength", object, "emissiveStrength"},
    {"material.extensions", "KHR_materials_transmission", object, "transmission"},
    {.owner = "transmission", .key = "transmissionFactor", .kind = number, .min = 0, .max = 1},
    {"transmission", "transmissionTexture", object, "textureInfo"},
    {"material.extensions", "KHR_materials_pbrSpecularGlossiness", object, "specularGlossiness"},
    {.owner = "specularGlossiness", .key = "diffuseFactor", .kind = numbers, .min = 0, .max = 1, .length = 4},
    {"specularGlossiness", "diffuseTexture", object, "textureInfo"},
    {.owner = "specularGlossiness", .key = "specularFactor", .kind = numbers, .min = 0, .max = 1, .length = 3},
    {.owner = "specularGlossiness", .key = "glossinessFactor", .kind = number, .min = 0, .max = 1},
    {"specularGlossiness", "specularGlossinessTexture", object, "textureInfo"},
    {.owner = "emissiveStrength", .key = "emissiveStrength", .kind = number, .min = 0},
    {.owner = "pbr", .key = "baseColorFactor", .kind = numbers, .min = 0, .max = 1, .length = 4},
    {"pbr", "baseColorTexture", object, "textureInfo"},
    {.owner = "pbr", .key = "metallicFactor", .kind = number, .min = 0, .max = 1},
    {.owner = "pbr", .key = "roughnessFactor", .kind = number, .min = 0, .max = 1},
    {"pbr", "metallicRoughnessTexture", object, "textureInfo"},
    {"textureInfo", "index", reference, "textures", true},
    {.owner = "textureInfo", .key = "texCoord", .kind = integer, .min = 0, .max = kMaxTexCoord},
    {"normalTexture", "index", reference, "textures", true},
    {.owner = "normalTexture", .key = "texCoord", .kind = integer, .min = 0, .max = kMaxTexCoord},
    {"normalTexture", "scale", number},
    {"occlusionTexture", "index", reference, "textures", true},
    {.owner = "occlusionTexture", .key = "texCoord", .kind = integer, .min = 0, .max = kMaxTexCoord},
    {.owner = "occlusionTexture", .key = "strength", .kind = number, .min = 0, .max = 1},

    {"textureInfo", "extensions", object, "textureInfo.extensions"},
    {"normalTexture", "extensions", object, "textureInfo.extensions"},
    {"occlusionTexture", "extensions", object, "textureInfo.extensions"},
    {"textureInfo.extensions", "KHR_texture_transform", object, "textureTransform"},
    {.owner = "textureTransform", .key = "offset", .kind = numbers, .min = -kMaxUv, .max = kMaxUv, .length = 2},
    {.owner = "textureTransform", .key = "rotation", .kind = number, .min = -kMaxUv, .max = kMaxUv},
    {.owner = "textureTransform", .key = "scale", .kind = numbers, .min = -kMaxUv, .max = kMaxUv, .length = 2},
    {.owner = "textureTransform", .key = "texCoord", .kind = integer, .min = 0, .max = kMaxTexCoord},

    {"texture", "source", reference, "images"},
    {"texture", "extensions", object, "texture.extensions"},
    {"texture.extensions", "EXT_texture_webp", object, "otherImage"},
    {"texture.extensions", "KHR_texture_basisu", object, "otherImage"},
    {"otherImage", "source", reference, "images"},
    {"texture", "sampler", reference, "samplers"},
    oneOf("sampler", "magFilter", integer, "9728 9729"),
    oneOf("sampler", "minFilter", integer, "9728 9729 9984 9985 9986 9987"),
    oneOf("sampler", "wrapS", integer, "33071 33648 10497"),
    oneOf("sampler", "wrapT", integer, "33071 33648 10497"),
    {"image", "name", string},
    {"image", "uri", string},
    {"image", "mimeType", string},
    {"image", "bufferView", reference, "bufferViews"},

    {"camera", "name", string},
    oneOf("camera", "type", string, "perspective orthographic", true),
    {"camera", "perspective", object, "perspective"},
    {"camera", "orthographic", object, "orthographic"},
    above0("perspective", "aspectRatio", false),
    above0("perspective", "yfov", true, std::numbers::pi),
    above0("perspective", "znear", true),
    above0("perspective", "zfar", false),
    {"orthographic", "xmag", number, {}, true},
    {"orthographic", "ymag", number, {}, true},
    {.owner = "orthographic", .key = "znear", .kind = number, .required = true, .min = 0},
    above0("orthographic", "zfar", true),

    {"lights", "lights", objects, "light", true},
    {"light", "name", string},
    oneOf("light", "type", string, "directional spot point", true),
    {.owner = "light", .key = "color", .kind = numbers, .min = 0, .length = 3},
    {.owner = "light", .key = "intensity", .kind = number, .min = 0},
    above0("light", "range", false),
    {"light", "spot", object, "spot"},
    {.owner = "spot", .key = "innerConeAngle", .kind = number, .min = 0, .max = std::numbers::pi / 2},
    above0("spot", "outerConeAngle", false, std::numbers::pi / 2),

    {"imageBasedLights", "lights", objects, "imageBasedLight", true},
    {"imageBasedLight", "name", string},
    {.owner = "imageBasedLight", .key = "rotation", .kind = numbers, .min = -1, .max = 1, .length = 4},
    {.owner = "imageBasedLight", .key = "intensity", .kind = number, .min = 0},
    {.owner = "imageBasedLight",
     .key = "irradianceCoefficients",
     .kind = numberRows,
     .required = true,
     .length = 3,
     .rows = 9},
    {.owner = "imageBasedLight",
     .key = "specularImages",
     .kind = referenceRows,
     .of = "images",
     .required = true,
     .length = 6},
    {.owner = "imageBasedLight", .key = "specularImageSize", .kind = number, .required = true, .min = 0},

    {"skin", "name", string},
    {"skin", "joints", references, "nodes", true},
    {"skin", "skeleton", reference, "nodes"},
    {"skin", "inverseBindMatrices", reference, "accessors"},
    {"animation", "name", string},
    {"animation", "channels", objects, "channel", true},
    {"animation", "samplers", objects, "animation.sampler", true},
    {"animation.sampler", "input", reference, "accessors", true},
    {"animation.sampler", "output", reference, "accessors", true},
    strictlyOneOf("animation.sampler", "interpolation", "LINEAR STEP CUBICSPLINE"),
    {"channel", "sampler", reference, "animation.samplers", true},
    {"channel", "target", object, "target", true},
    {"target", "node", reference, "nodes"},
    {"target", "path", string, {}, true},
    {"target", "extensions", object, "target.extensions"},
    {"target.extensions", "KHR_animation_pointer", object, "animationPointer"},
    {"animationPointer", "pointer", string, {}, true},
};

} // namespace

std::span<const GltfField> gltfFields() {
  return kFields;
}

} // namespace gnomon
