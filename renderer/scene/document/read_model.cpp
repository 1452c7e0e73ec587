#include "renderer/scene/document/read_model.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon {

namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 2> kMeshopt{"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// An integer of glTF, where it has another name for a type.
ComponentType componentTypeOf(const json& object) {
  return static_cast<ComponentType>(object["componentType"].get<int>());
}

std::vector<int> indicesAt(const json& object, const char* key) {
  return object.value(key, std::vector<int>());
}

std::optional<glm::dmat4> matrixAt(const json& object) {
  const json* member = memberOf(object, "matrix");
  if (member == nullptr) return std::nullopt;
  glm::dmat4 matrix(0);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*member)[static_cast<std::size_t>(i)].get<double>();
  return matrix;
}

gltf::Node readNode(const json& source) {
  gltf::Node node;
  node.name = nameAt(source);
  node.children = indicesAt(source, "children");
  node.mesh = source.value("mesh", -1);
  node.camera = source.value("camera", -1);
  node.skin = source.value("skin", -1);
  node.matrix = matrixAt(source);
  node.translation = vectorAt<3>(source, "translation");
  node.rotation = vectorAt<4>(source, "rotation");
  node.scale = vectorAt<3>(source, "scale");
  node.weights = optionalAt<std::vector<double>>(source, "weights");
  if (const json* light = extensionOf(source, "KHR_lights_punctual")) node.light = (*light)["light"].get<int>();
  if (const json* instancing = extensionOf(source, "EXT_mesh_gpu_instancing")) {
    node.instancing = (*instancing)["attributes"].get<gltf::Attributes>();
  }
  if (const json* visibility = extensionOf(source, "KHR_node_visibility")) {
    node.visible = visibility->value("visible", true);
  }
  return node;
}

gltf::Primitive readPrimitive(const json& source) {
  gltf::Primitive primitive;
  primitive.attributes = source["attributes"].get<gltf::Attributes>();
  primitive.indices = source.value("indices", -1);
  primitive.material = source.value("material", -1);
  primitive.mode = static_cast<PrimitiveMode>(source.value("mode", 4));
  primitive.targets = listAt(source, "targets", [](const json& target) { return target.get<gltf::Attributes>(); });
  if (const json* draco = extensionOf(source, "KHR_draco_mesh_compression")) {
    primitive.draco = gltf::Draco{(*draco)["bufferView"].get<std::size_t>(),
                                  draco->value("attributes", std::map<std::string, std::uint32_t>())};
  }
  if (const json* variants = extensionOf(source, "KHR_materials_variants")) {
    primitive.variantMappings = listAt(*variants, "mappings", [](const json& mapping) {
      return gltf::VariantMapping{mapping["material"].get<int>(), mapping["variants"].get<std::vector<std::size_t>>()};
    });
  }
  return primitive;
}

gltf::Mesh readMesh(const json& source) {
  return {listAt(source, "primitives", readPrimitive), optionalAt<std::vector<double>>(source, "weights")};
}

constexpr std::array<std::string_view, 7> kElementTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::array<std::string_view, 3> kMeshoptModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> kMeshoptFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
constexpr std::array<std::string_view, 3> kLightTypes{"directional", "spot", "point"};
constexpr std::array<std::string_view, 3> kInterpolations{"LINEAR", "STEP", "CUBICSPLINE"};

gltf::Accessor readAccessor(const json& source) {
  gltf::Accessor accessor;
  accessor.faulty = !faultOf(source).empty();
  if (accessor.faulty) return accessor;
  accessor.bufferView = source.value("bufferView", -1);
  accessor.byteOffset = source.value("byteOffset", std::size_t{0});
  accessor.componentType = componentTypeOf(source);
  accessor.type = namedAt(source, "type", kElementTypes, ElementType::scalar);
  accessor.normalized = source.value("normalized", false);
  accessor.count = source["count"].get<std::size_t>();
  accessor.min = source.value("min", std::vector<double>());
  accessor.max = source.value("max", std::vector<double>());
  if (const json* sparse = memberOf(source, "sparse")) {
    const json& indices = (*sparse)["indices"];
    const json& values = (*sparse)["values"];
    accessor.sparse = gltf::Sparse{(*sparse)["count"].get<std::size_t>(),
                                   indices["bufferView"].get<int>(),
                                   indices.value("byteOffset", std::size_t{0}),
                                   componentTypeOf(indices),
                                   values["bufferView"].get<int>(),
                                   values.value("byteOffset", std::size_t{0})};
  }
  return accessor;
}

/// The extension under the first of its names that the object has.
std::pair<const json*, std::string_view> meshoptOf(const json& object) {
  for (const std::string_view name : kMeshopt) {
    if (const json* extension = extensionOf(object, name)) return {extension, name};
  }
  return {nullptr, {}};
}

gltf::BufferView readBufferView(const json& source) {
  gltf::BufferView view;
  view.faulty = !faultOf(source).empty();
  if (view.faulty) return view;
  view.buffer = source["buffer"].get<std::size_t>();
  view.byteOffset = source.value("byteOffset", std::uint64_t{0});
  view.byteLength = source["byteLength"].get<std::uint64_t>();
  if (source.contains("byteStride")) view.byteStride = source["byteStride"].get<std::uint64_t>();
  if (const auto [meshopt, name] = meshoptOf(source); meshopt != nullptr) {
    view.meshopt = gltf::Meshopt{name,
                                 (*meshopt)["buffer"].get<std::size_t>(),
                                 meshopt->value("byteOffset", std::uint64_t{0}),
                                 (*meshopt)["byteLength"].get<std::uint64_t>(),
                                 (*meshopt)["byteStride"].get<std::uint64_t>(),
                                 (*meshopt)["count"].get<std::uint64_t>(),
                                 namedAt(*meshopt, "mode", kMeshoptModes, MeshoptMode::attributes),
                                 namedAt(*meshopt, "filter", kMeshoptFilters, MeshoptFilter::none)};
  }
  return view;
}

/// Moved out of the document.
std::optional<std::string> takeUri(json& object) {
  const auto uri = object.find("uri");
  if (uri == object.end()) return std::nullopt;
  return std::move(uri->get_ref<std::string&>());
}

gltf::Buffer readBuffer(json& source) {
  if (!faultOf(source).empty()) return {{}, 0, false, true};
  const json* meshopt = meshoptOf(source).first;
  return {takeUri(source), source["byteLength"].get<std::uint64_t>(),
          meshopt != nullptr && meshopt->value("fallback", false)};
}

gltf::Image readImage(json& source) {
  return {optionalAt<std::string>(source, "name"), takeUri(source), source.value("bufferView", -1)};
}

gltf::Camera readCamera(const json& source) {
  gltf::Camera camera;
  camera.name = nameAt(source);
  camera.fault = faultOf(source);
  if (!camera.fault.empty()) return camera;
  camera.isPerspective = source["type"] == "perspective";
  if (const json* lens = memberOf(source, "perspective")) {
    camera.perspective = gltf::PerspectiveLens{(*lens)["yfov"].get<double>(), (*lens)["znear"].get<double>()};
    if (const json* far = memberOf(*lens, "zfar")) camera.perspective->zfar = far->get<double>();
  }
  if (const json* lens = memberOf(source, "orthographic")) {
    camera.orthographic = gltf::OrthographicLens{(*lens)["xmag"].get<double>(), (*lens)["ymag"].get<double>(),
                                                 (*lens)["znear"].get<double>(), (*lens)["zfar"].get<double>()};
  }
  return camera;
}

gltf::PunctualLight readLight(const json& source) {
  gltf::PunctualLight light;
  light.name = nameAt(source);
  light.fault = faultOf(source);
  if (!light.fault.empty()) return light;
  light.type = namedAt(source, "type", kLightTypes, LightType::directional);
  light.color = vectorAt<3>(source, "color");
  light.intensity = source.value("intensity", 1.0);
  if (const json* range = memberOf(source, "range")) light.range = range->get<double>();
  if (const json* spot = memberOf(source, "spot")) {
    light.spot = gltf::SpotCone{};
    light.spot->inner = spot->value("innerConeAngle", light.spot->inner);
    light.spot->outer = spot->value("outerConeAngle", light.spot->outer);
  }
  return light;
}

gltf::Scene readScene(const json& source) {
  gltf::Scene scene{indicesAt(source, "nodes")};
  if (const json* light = extensionOf(source, "EXT_lights_image_based")) {
    scene.imageBasedLight = (*light)["light"].get<int>();
  }
  return scene;
}

gltf::ImageBasedLight readImageBasedLight(const json& source) {
  gltf::ImageBasedLight light;
  light.name = nameAt(source);
  light.fault = faultOf(source);
  if (!light.fault.empty()) return light;
  light.rotation = vectorAt<4>(source, "rotation").value_or(light.rotation);
  light.intensity = source.value("intensity", light.intensity);
  const json& coefficients = source["irradianceCoefficients"];
  for (std::size_t i = 0; i < light.irradianceCoefficients.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      light.irradianceCoefficients[i][channel] = coefficients[i][static_cast<std::size_t>(channel)].get<double>();
    }
  }
  light.specularImages = source["specularImages"].get<std::vector<std::array<int, 6>>>();
  light.specularImageSize = source["specularImageSize"].get<double>();
  return light;
}

gltf::Skin readSkin(const json& source) {
  return {indicesAt(source, "joints"), source.value("inverseBindMatrices", -1)};
}

gltf::AnimationChannel readChannel(const json& source) {
  const json& target = source["target"];
  gltf::AnimationChannel channel{source["sampler"].get<std::size_t>(), target.value("node", -1),
                                 target["path"].get<std::string>(), std::nullopt};
  if (const json* extension = extensionOf(target, "KHR_animation_pointer")) {
    channel.pointer = (*extension)["pointer"].get<std::string>();
  }
  return channel;
}

gltf::AnimationSampler readSampler(const json& source) {
  if (!faultOf(source).empty()) return {.faulty = true};
  return {source["input"].get<std::size_t>(), source["output"].get<std::size_t>(),
          namedAt(source, "interpolation", kInterpolations, Interpolation::linear)};
}

gltf::Animation readAnimation(const json& source) {
  gltf::Animation animation{nameAt(source), {}, {}};
  if (!faultOf(source).empty()) return animation;
  for (const json& channel : source["channels"]) {
    if (faultOf(channel).empty()) animation.channels.push_back(readChannel(channel));
  }
  animation.samplers = listAt(source, "samplers", readSampler);
  return animation;
}

} // namespace

gltf::Model readModel(json document) {
  gltf::Model model;
  model.scene = document.value("scene", -1);
  model.scenes = listAt(document, "scenes", readScene);
  model.nodes = listAt(document, "nodes", readNode);
  if (const json* rtc = extensionOf(document, "CESIUM_RTC")) model.center = *vectorAt<3>(*rtc, "center");
  model.meshes = listAt(document, "meshes", readMesh);
  model.accessors = listAt(document, "accessors", readAccessor);
  model.bufferViews = listAt(document, "bufferViews", readBufferView);
  if (document.contains("buffers")) {
    for (json& buffer : document["buffers"]) model.buffers.push_back(readBuffer(buffer));
  }
  if (document.contains("images")) {
    for (json& image : document["images"]) model.images.push_back(readImage(image));
  }
  model.textures = listAt(document, "textures", readTexture);
  model.samplers = listAt(document, "samplers", readTextureSampler);
  model.materials = listAt(document, "materials", readMaterial);
  model.cameras = listAt(document, "cameras", readCamera);
  if (const json* lights = extensionOf(document, "KHR_lights_punctual")) {
    model.lights = listAt(*lights, "lights", readLight);
  }
  if (const json* lights = extensionOf(document, "EXT_lights_image_based")) {
    model.imageBasedLights = listAt(*lights, "lights", readImageBasedLight);
  }
  model.skins = listAt(document, "skins", readSkin);
  model.animations = listAt(document, "animations", readAnimation);
  if (const json* variants = extensionOf(document, "KHR_materials_variants")) {
    model.variants = listAt(*variants, "variants", [](const json& variant) { return nameAt(variant); });
  }
  model.extensionsUsed = document.value("extensionsUsed", std::vector<std::string>());
  return model;
}

} // namespace gnomon
