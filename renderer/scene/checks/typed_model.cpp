#include "renderer/scene/checks/typed_model.h"

#include <limits>
#include <string>

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kDrawn[] = {"asset",     "scene",       "scenes",   "nodes",   "meshes",
                                  "accessors", "bufferViews", "textures", "samplers"};

/// A copy without extras and with no extension but Draco's. Recursion is bounded by the JSON's depth, which
/// parseJsonText() has limited.
json pruned(const json& value) {
  if (value.is_array()) {
    json array = json::array();
    for (const json& element : value) array.push_back(pruned(element));
    return array;
  }
  if (!value.is_object()) return value;
  json object = json::object();
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (key == "extensions" && member.is_object()) {
      const auto extension = member.find(kDraco);
      if (extension != member.end()) object[key][kDraco] = pruned(*extension);
    } else {
      object[key] = pruned(member);
    }
  }
  return object;
}

/// tinygltf refuses indices whose accessor has no buffer view: those of compressed primitives, and those that are zeros
/// but for sparse values.
void dropIndices(json& drawn) {
  const auto meshes = drawn.find("meshes");
  if (meshes == drawn.end()) return;
  for (json& mesh : *meshes) {
    for (json& primitive : mesh["primitives"]) primitive.erase("indices");
  }
}

void restoreIndices(const json& document, tinygltf::Model& model) {
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    auto& primitives = model.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      primitives[p].indices = document.at("meshes")[m].at("primitives")[p].value("indices", -1);
    }
  }
}

bool noFile(const std::string&, void*) {
  return false;
}
std::string noPath(const std::string&, void*) {
  return {};
}
bool noRead(std::vector<unsigned char>*, std::string*, const std::string&, void*) {
  return false;
}
bool noWrite(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}
bool noImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return false;
}

} // namespace

Result<tinygltf::Model> typedModel(const json& document) {
  const Problem refused{ProblemCode::invalidScene, {}, "The glTF does not follow the schema of glTF 2.0.", {}, {}};
  try {
    json drawn = json::object();
    for (const char* key : kDrawn) {
      const auto member = document.find(key);
      if (member != document.end()) drawn[key] = pruned(*member);
    }
    dropIndices(drawn);
    const std::string text = drawn.dump();
    drawn = nullptr;
    if (text.size() > std::numeric_limits<unsigned int>::max()) return refused;

    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({noFile, noPath, noRead, noWrite, nullptr});
    parser.SetImageLoader(noImage, nullptr);
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    if (!parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned int>(text.size()),
                                    "")) {
      return refused;
    }
    restoreIndices(document, model);
    return model;
  } catch (const std::exception&) {
    return refused;
  }
}

} // namespace gnomon
