#include "renderer/scene/gltf_json.h"

namespace gnomon {

const nlohmann::json* extensionOf(const nlohmann::json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

std::string nameOf(const nlohmann::json& object) {
  return object.value("name", std::string());
}

} // namespace gnomon
