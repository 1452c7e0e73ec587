#include "clients/cli/config/client_config.h"

#include <algorithm>
#include <filesystem>

#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

constexpr std::string_view kPresetPrefix = "preset.";

std::string placeOf(const std::string& file, int line) {
  return file + ":" + std::to_string(line);
}

} // namespace

std::string usualConfigFile(const char* xdgConfigHome, const char* home) {
  const auto isAbsolute = [](const char* path) { return path != nullptr && path[0] == '/'; };
  if (isAbsolute(xdgConfigHome)) return std::string(xdgConfigHome) + "/gnomon/config";
  if (isAbsolute(home)) return std::string(home) + "/.config/gnomon/config";
  return {};
}

Result<ClientConfig> parseClientConfig(std::string_view text, const std::string& file,
                                       std::span<const std::string> keys) {
  auto [sections, problems] = parseSections(text, file);
  ClientConfig config{file, {}};
  const auto fail = [&, &problems = problems](int line, const std::string& detail) {
    problems.push_back(invalidValue(placeOf(file, line), detail));
  };
  for (ConfigSection& section : sections) {
    for (const ConfigEntry& entry : section.entries) {
      if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
      fail(entry.line, "There is no key " + asciiExcerpt(entry.key) + suggestion(entry.key, keys));
    }
    const bool isPreset = section.name.starts_with(kPresetPrefix);
    if (!section.name.empty() && !isPreset) {
      fail(section.line, "A section is [preset.NAME], not [" + asciiExcerpt(section.name) + "].");
    }
    config.layers.push_back({isPreset ? section.name.substr(kPresetPrefix.size()) : "", std::move(section.entries)});
  }
  if (!problems.empty()) return problems;
  return config;
}

Result<std::vector<ConfigLayer>> layersOf(const ClientConfig& config, std::span<const std::string> presets) {
  std::vector<ConfigLayer> layers;
  std::vector<std::string> names;
  for (const ConfigLayer& layer : config.layers) {
    if (layer.preset.empty()) layers.push_back(layer);
    if (!layer.preset.empty()) names.push_back(layer.preset);
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  const std::string where = config.file.empty() ? "There is no configuration" : config.file + " has no preset";
  for (const std::string& preset : presets) {
    const auto found = std::find_if(config.layers.begin(), config.layers.end(), [&](const ConfigLayer& layer) {
      return !layer.preset.empty() && layer.preset == preset;
    });
    if (found == config.layers.end()) {
      return Problem{ProblemCode::notFound, "--preset", where + suggestion(preset, names), list, asciiExcerpt(preset)};
    }
    layers.push_back(*found);
  }
  return layers;
}

std::string fileNamedIn(const std::string& configFile, const std::string& name, const char* home) {
  if (name.starts_with("~/") && home != nullptr) return home + name.substr(1);
  return (std::filesystem::path(configFile).parent_path() / name).string();
}

} // namespace gnomon::cli
