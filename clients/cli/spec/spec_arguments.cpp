#include "clients/cli/spec/spec_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "clients/cli/files/file_io.h"
#include "protocol/base/json.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/json_source.h"
#include "protocol/spec/environment_rows.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

/// The place one step below `node`, made where it may be made; null when the step can't be taken.
Json* stepInto(Json& node, const FieldStep& step) {
  const auto* name = std::get_if<std::string>(&step);
  if (node.is_null()) node = name ? Json::object() : Json::array();
  if (node.is_object()) {
    const std::string key = name ? *name : std::to_string(std::get<std::size_t>(step));
    return key.empty() ? nullptr : &node[key];
  }
  if (!node.is_array() || name || std::get<std::size_t>(step) > node.size()) return nullptr;
  const std::size_t index = std::get<std::size_t>(step);
  if (index == node.size()) node.push_back(nullptr);
  return &node[index];
}

} // namespace

std::string pointerOf(std::string_view path) {
  const auto steps = fieldSteps(path);
  return steps ? gnomon::pointerOf(*steps) : "/" + std::string(path);
}

Status setAtPath(Json& root, std::string_view path, Json value) {
  const auto steps = fieldSteps(path);
  if (!steps) {
    Problem problem = steps.problems().front();
    problem.pointer = pointerOf(path);
    return problem;
  }
  if (steps->size() > static_cast<std::size_t>(kLimits.maxJsonDepth)) {
    return invalidValue("", "The path is too deep.", std::to_string(kLimits.maxJsonDepth) + " steps",
                        std::to_string(steps->size()));
  }
  Json* place = &root;
  std::vector<FieldStep> taken;
  for (const FieldStep& step : *steps) {
    taken.push_back(step);
    place = stepInto(*place, step);
    if (!place) {
      return invalidValue(gnomon::pointerOf(taken), "Unknown field.");
    }
  }
  *place = std::move(value);
  return Done{};
}

Result<Json> valueOf(std::string_view text) {
  const bool isWord = text == "true" || text == "false" || text == "null";
  const bool isJson = isWord || (!text.empty() && std::string_view("{[\"-0123456789").find(text[0]) != text.npos);
  if (!isJson) return Json(std::string(text));
  ProblemList problems;
  if (!readJson(text, problems) || !problems.empty()) return std::move(problems).take();
  return Json::parse(text);
}

namespace {

template <class Number>
std::optional<Number> parseWhole(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The camera's lens stays; how the eye was placed goes.
void replacePlacement(Json& spec, const char* key, Json value) {
  Json& camera = spec["camera"];
  if (!camera.is_object()) camera = Json::object();
  for (const char* placement : {"eye", "target", "up", "orbit", "node", "fit"}) camera.erase(placement);
  camera[key] = std::move(value);
}

/// The target of an orbit that the spec has stays.
Json orbitOf(const Json& spec, const std::vector<double>& numbers) {
  Json orbit = Json::object();
  const Json::json_pointer oldTarget("/camera/orbit/target");
  if (spec.contains(oldTarget)) orbit["target"] = spec[oldTarget];
  orbit["azimuthDegrees"] = numbers[0];
  orbit["elevationDegrees"] = numbers[1];
  if (numbers.size() > 2) orbit["distance"] = numbers[2];
  return orbit;
}

bool isDirectional(const Json& light) {
  return light.is_object() && (!light.contains("type") || light["type"] == "directional");
}

/// The environment that a flag names, in place of another; how it is turned and shown stays. Gives the pointer of what
/// was set.
std::string replaceEnvironment(Json& spec, const std::string& text) {
  Json& environment = spec["environment"];
  if (!environment.is_object()) environment = Json::object();
  const bool isWord = std::find(kEnvironmentWords.begin(), kEnvironmentWords.end(), text) != kEnvironmentWords.end();
  environment.erase("file");
  environment.erase("light");
  if (text == "studio" && !environment.contains("studio")) environment["studio"] = spell(Studio::lamps);
  if (text != "sky") environment.erase("sky");
  if (text == "sky" && !environment.contains("sky")) environment["sky"] = Json::object();
  if (!isWord) environment["file"] = std::filesystem::path(text).filename().string();
  return text == "sky" ? "/environment/sky" : isWord ? "/environment" : "/environment/file";
}

Json sunJson(const Sun& sun) {
  Json place = Json::object();
  if (sun.azimuthDegrees) place["azimuthDegrees"] = *sun.azimuthDegrees;
  if (sun.elevationDegrees) place["elevationDegrees"] = *sun.elevationDegrees;
  if (sun.latitudeDegrees) place["latitudeDegrees"] = *sun.latitudeDegrees;
  if (sun.longitudeDegrees) place["longitudeDegrees"] = *sun.longitudeDegrees;
  if (sun.time) place["time"] = *sun.time;
  return place;
}

/// Gives the pointer of the sun that was turned.
std::string turnSun(Json& spec, const Sun& sun) {
  const Json::json_pointer sky("/environment/sky");
  if (spec.contains(sky) && spec[sky].is_object()) {
    spec[sky]["sun"] = sunJson(sun);
    return "/environment/sky/sun";
  }
  Json& lights = spec["lights"];
  if (!lights.is_array()) lights = Json::array();
  auto light = std::find_if(lights.begin(), lights.end(), isDirectional);
  if (light == lights.end()) {
    lights.push_back({{"type", "directional"}});
    light = lights.end() - 1;
  }
  light->erase("direction");
  (*light)["sun"] = sunJson(sun);
  return "/lights/" + std::to_string(light - lights.begin()) + "/sun";
}

/// Steps and north stay. The view joins those that are named.
void showSunHours(Json& spec, const SunHours& hours) {
  Json& asked = spec["sunHours"];
  if (!asked.is_object()) asked = Json::object();
  asked["latitudeDegrees"] = *hours.latitudeDegrees;
  asked["longitudeDegrees"] = *hours.longitudeDegrees;
  asked["begin"] = hours.begin;
  asked["end"] = hours.end;
  Json& views = spec["views"];
  if (!views.is_array()) views = Json::array();
  if (std::find(views.begin(), views.end(), "sunHours") == views.end()) views.push_back("sunHours");
}

/// Into the `output` that the spec has, unless that is no object, which is a problem of its own.
void setFormat(Json& spec, const std::string& format, FlagOrigins& origins) {
  Json& output = spec["output"];
  if (output.is_null()) output = Json::object();
  if (!output.is_object()) return;
  output["format"] = format;
  origins.emplace("/output/format", "--output");
}

/// Lays the flags over `spec` and notes which flag set what.
Status applyFlags(Json& spec, const SpecArguments& flags, FlagOrigins& origins) {
  const auto set = [&](const char* key, Json value, const char* flag) {
    spec[key] = std::move(value);
    origins[std::string("/") + key] = flag;
  };
  if (flags.width) set("width", *flags.width, "--width");
  if (flags.height) set("height", *flags.height, "--height");
  if (flags.camera) {
    replacePlacement(spec, "node", *flags.camera);
    origins["/camera/node"] = "--camera";
  }
  if (flags.orbit) {
    Json orbit = orbitOf(spec, *flags.orbit);
    replacePlacement(spec, "orbit", std::move(orbit));
    origins["/camera/orbit"] = "--orbit";
  }
  Problems problems;
  for (const FieldFlag& field : kFieldFlags) {
    const auto given = flags.fields.find(field.flag);
    if (given == flags.fields.end()) continue;
    const auto pointer = applyFieldFlag(spec, field, given->second);
    if (pointer) origins[*pointer] = field.flag;
    if (!pointer) problems.insert(problems.end(), pointer.problems().begin(), pointer.problems().end());
  }
  if (flags.device) set("device", *flags.device, "--device");
  if (flags.environment) origins[replaceEnvironment(spec, *flags.environment)] = "--environment";
  if (flags.sun) origins[turnSun(spec, *flags.sun)] = "--sun";
  if (!flags.views.empty()) set("views", flags.views, "--view");
  if (flags.sunHours) {
    showSunHours(spec, *flags.sunHours);
    origins["/sunHours"] = "--sun-hours";
  }
  for (const auto& [path, text] : flags.sets) {
    const auto value = valueOf(text);
    const Status done = value ? setAtPath(spec, path, *value) : Status(value.problems());
    for (Problem problem : done ? Problems() : done.problems()) {
      if (!value) problem.pointer = pointerOf(path) + problem.pointer;
      origins.emplace(problem.pointer, "--set " + path); // of a step that can't be taken: above the path's end
      problems.push_back(std::move(problem));
    }
    origins[pointerOf(path)] = "--set " + path;
  }
  if (flags.format) setFormat(spec, *flags.format, origins);
  if (!problems.empty()) return problems;
  return Done{};
}

} // namespace

std::string checkEnvironment(std::string_view text) {
  if (std::find(kEnvironmentWords.begin(), kEnvironmentWords.end(), text) != kEnvironmentWords.end()) return "";
  const std::string suffix = lowerCase(std::filesystem::path(text).extension().string());
  return suffix == ".hdr" || suffix == ".exr" ? "" : "needs a .hdr or .exr file, or the word sky or studio";
}

std::optional<std::string> formatOfSets(const std::vector<std::pair<std::string, std::string>>& sets) {
  Json spec = Json::object();
  for (const auto& [path, text] : sets) {
    if (path != "output" && path != "output.format") continue;
    const auto value = valueOf(text);
    if (!value || !setAtPath(spec, path, *value)) return std::nullopt; // reported where the sets are applied
  }
  const Json::json_pointer format("/output/format");
  if (!spec.contains(format) || !spec[format].is_string()) return std::nullopt;
  return spec[format].get<std::string>();
}

Problems ofRequest(const std::string& file, Problems problems) {
  return file.empty() ? problems : about(file == "-" ? "standard input" : file, std::move(problems));
}

ResolvedSpec resolveSpec(const std::string& specJson, const SpecArguments& arguments, const std::string& file) {
  // First by itself: a duplicate key, say, would be gone once the flags are laid over it.
  auto given = decodeFrameSpec(specJson);
  if (!given) return {ofRequest(file, given.problems()), {}, "{}"};
  Json spec = Json::parse(specJson, nullptr, false);
  if (!spec.is_object()) spec = Json::object(); // an empty text is a spec, too
  FlagOrigins origins;
  if (auto applied = applyFlags(spec, arguments, origins); !applied) return {applied.problems(), origins, "{}"};
  std::string json = spec.dump();
  return {decodeFrameSpec(json), origins, json};
}

Result<std::string> specText(const std::string& file) {
  if (file.empty()) return std::string("{}");
  return readText(file, kLimits.maxSpecBytes);
}

ResolvedSpec resolveSpecFile(const std::string& file, const SpecArguments& arguments) {
  const auto text = specText(file);
  if (!text) return {text.problems(), {}, "{}"};
  return resolveSpec(*text, arguments, file);
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t least, std::size_t most) {
  std::vector<double> numbers;
  for (std::size_t begin = 0;;) {
    const auto comma = text.find(',', begin);
    const auto number = parseWhole<double>(text.substr(begin, comma - begin));
    if (!number || !std::isfinite(*number) || numbers.size() == most) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) break;
    begin = comma + 1;
  }
  if (numbers.size() < least) return std::nullopt;
  return numbers;
}

std::optional<std::array<int, 2>> parseSize(std::string_view text) {
  const auto cross = text.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto width = parseWhole<int>(text.substr(0, cross)), height = parseWhole<int>(text.substr(cross + 1));
  if (!width || !height) return std::nullopt;
  return std::array<int, 2>{*width, *height};
}

} // namespace gnomon::cli
