#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "protocol/base/scene_bundle.h"
#include "tests/support/files.h"

namespace gnomon::testing {

/// A model that a manifest.json of gathered ones lists, and the files that it lists with it, named as the model names
/// them.
inline SceneBundle gatheredBundle(const std::filesystem::path& assets, const nlohmann::json& entry) {
  const std::filesystem::path model = assets / entry.at("path").get<std::string>();
  SceneBundle bundle{readFile(model), {}};
  for (const auto& name : entry.at("files")) {
    const std::filesystem::path file = assets / name.get<std::string>();
    if (file == model) continue;
    bundle.files[file.lexically_relative(model.parent_path()).generic_string()] = readFile(file);
  }
  return bundle;
}

} // namespace gnomon::testing
