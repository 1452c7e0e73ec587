#include <algorithm>
#include <nlohmann/json.hpp>

#include "clients/cli/spec/spec_arguments.h"
#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

Problem notA(const FieldFlag& flag, const char* need, std::string_view text) {
  return invalidValue(flag.flag, std::string("needs ") + need, flag.typeName, asciiExcerpt(text));
}

bool isIndex(std::string_view text) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && text.size() < 10 && std::all_of(text.begin(), text.end(), isDigit);
}

/// The object that holds the field, made where it may be made.
Json* parentOf(Json& spec, const std::vector<std::string>& steps) {
  Json* place = &spec;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (place->is_null()) *place = Json::object();
    if (!place->is_object()) return nullptr;
    place = &(*place)[steps[i]];
  }
  if (place->is_null()) *place = Json::object();
  return place->is_object() ? place : nullptr;
}

} // namespace

Result<Json> fieldValue(const FieldFlag& flag, std::string_view text) {
  switch (flag.value) {
    case FlagValue::number:
      if (const auto number = parseNumbers(text, 1, 1)) return Json((*number)[0]);
      return notA(flag, "a number", text);
    case FlagValue::threeNumbers:
      if (const auto numbers = parseNumbers(text, 3, 3)) return Json(*numbers);
      return notA(flag, "three numbers with commas between", text);
    case FlagValue::color:
      if (const auto numbers = parseNumbers(text, 3, 4)) return Json(*numbers);
      return notA(flag, "three numbers with commas between, red, green and blue, or four with alpha", text);
    case FlagValue::word:
      return Json(std::string(text));
    case FlagValue::nameOrIndex:
      break;
  }
  if (isIndex(text)) return Json(std::stoi(std::string(text)));
  return Json(std::string(text));
}

Result<std::string> applyFieldFlag(Json& spec, const FieldFlag& flag, std::string_view text) {
  auto value = fieldValue(flag, text);
  if (!value) return value.problems();
  std::string path = flag.path;
  if (flag.value == FlagValue::nameOrIndex) path += value->is_number() ? ".index" : ".name";
  if (flag.value == FlagValue::color) path += ".color";
  const auto steps = split(path, '.');
  // First, since erasing moves what follows.
  const auto camera = spec.find("camera");
  const bool hasCamera = camera != spec.end() && camera->is_object();
  for (const std::string& other : splitTrimmed(hasCamera ? flag.replaces : "", ' ')) camera->erase(other);
  Json* parent = parentOf(spec, steps);
  if (parent == nullptr) {
    return invalidValue(pointerOf(path), "Unknown field.");
  }
  if (flag.value == FlagValue::nameOrIndex) parent->erase(value->is_number() ? "name" : "index");
  if (flag.value == FlagValue::color) {
    if (value->size() > 3) (*parent)["alpha"] = (*value)[3];
    (*parent)["color"] = {(*value)[0], (*value)[1], (*value)[2]};
    return pointerOf(flag.path);
  }
  (*parent)[steps.back()] = *std::move(value);
  return pointerOf(path);
}

} // namespace gnomon::cli
