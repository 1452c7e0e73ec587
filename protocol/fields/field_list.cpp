#include "protocol/fields/field_list.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/fields/field_checks.h"
#include "protocol/fields/field_codec.h"
#include "protocol/fields/json_schema.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {
namespace {

std::string joined(std::span<const Spelling> spellings) {
  std::string text;
  for (const Spelling& spelling : spellings) {
    if (!text.empty()) text += " | ";
    text += spelling.name;
  }
  return text;
}

/// The words for a value's type.
std::string typeText(const ValueType& type) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      return "true | false";
    case Kind::integer:
    case Kind::integer64:
    case Kind::unsigned64:
      return "whole number";
    case Kind::number:
      return "number";
    case Kind::text:
      return "string";
    case Kind::indexOrName:
      return "whole number or string";
    case Kind::word:
      return joined(type.spellings);
    case Kind::optional:
      return typeText(*type.element);
    case Kind::array:
      return std::to_string(type.arraySize) + " numbers";
    case Kind::list:
      return "list of " + typeText(*type.element);
    case Kind::object:
      return std::string(type.object->name);
    case Kind::custom:
      return "object";
  }
  return {};
}

bool isList(const ValueType& type) {
  if (type.kind == ValueType::Kind::optional) return isList(*type.element);
  return type.kind == ValueType::Kind::list;
}

/// The struct that a member leads to, through optionals and lists; null = it holds a value.
const StructType* structIn(const ValueType& type) {
  const bool holds = type.kind == ValueType::Kind::optional || type.kind == ValueType::Kind::list;
  return holds ? structIn(*type.element) : type.object;
}

/// The names of the structs that are always there, outside of lists.
void collectOutsideLists(const StructType& type, std::set<std::string_view>& names) {
  names.insert(type.name);
  for (const FieldType& field : type.fields) {
    const StructType* inner = structIn(*field.type);
    const bool always = field.inlined || field.type->kind == ValueType::Kind::object;
    if (inner && always) collectOutsideLists(*inner, names);
  }
}

Notes withoutUnit(Notes notes) {
  notes.unit = {};
  return notes;
}

class FieldWalk {
 public:
  explicit FieldWalk(const StructType& root) { collectOutsideLists(root, outsideLists_); }

  void walk(const StructType& type, const std::string& prefix, bool inList, bool absent) {
    for (const FieldType& field : type.fields) {
      const std::string path = prefix + std::string(field.name);
      const StructType* inner = structIn(*field.type);
      if (field.inlined) {
        walk(*inner, prefix, inList, true);
      } else if (inner && (!inList || !outsideLists_.contains(inner->name))) {
        const bool list = isList(*field.type);
        walk(*inner, path + (list ? "[]." : "."), inList || list, false);
      } else {
        add(type, field, path, absent);
      }
    }
  }

  std::vector<FieldEntry> take() && { return std::move(entries_); }

 private:
  void add(const StructType& owner, const FieldType& field, const std::string& path, bool absent) {
    const Notes& notes = *field.notes;
    Json components = Json::object();
    Json schema = schemaOf(*field.type, notes, components);
    std::string preset;
    if (field.type->kind != ValueType::Kind::optional && !absent) {
      const Json value = encodeValue(*field.type, field.member(owner.initial()));
      preset = value.dump();
      schema["default"] = value;
    }
    if (!schema.contains("$ref")) schema["description"] = describe(notes, *field.type);
    entries_.push_back({path, typeText(*field.type), rangeText(notes), std::string(notes.unit), preset,
                        describe(withoutUnit(notes), *field.type), std::move(schema)});
  }

  std::set<std::string_view> outsideLists_;
  std::vector<FieldEntry> entries_;
};

/// A vertical bar would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
  return text;
}

std::string bounds(const FieldEntry& entry) {
  if (entry.allowed.empty() || entry.unit.empty()) return entry.allowed + entry.unit;
  return entry.allowed + " " + entry.unit;
}

} // namespace

std::vector<FieldEntry> frameFields() {
  const StructType& root = *typeOf<FrameSpec>().object;
  FieldWalk walk(root);
  walk.walk(root, "", false, false);
  return std::move(walk).take();
}

std::string fieldTable() {
  std::string text = "| field | type | range | default | meaning |\n|---|---|---|---|---|\n";
  for (const FieldEntry& entry : frameFields()) {
    const std::string preset = entry.preset.empty() ? "" : "`" + entry.preset + "`";
    text += "| `" + entry.path + "` | " + cell(entry.type) + " | " + bounds(entry) + " | " + preset + " | " +
            cell(entry.says) + " |\n";
  }
  return text;
}

std::string fieldHelp() {
  const std::vector<FieldEntry> entries = frameFields();
  std::size_t width = 0;
  for (const FieldEntry& entry : entries) width = std::max(width, entry.path.size());
  std::string text;
  for (const FieldEntry& entry : entries) {
    text += "  " + entry.path + std::string(width - entry.path.size() + 2, ' ') + entry.says;
    std::string facts = entry.type;
    if (const std::string limits = bounds(entry); !limits.empty()) facts += ", " + limits;
    if (!entry.preset.empty()) facts += ", default " + entry.preset;
    text += " (" + facts + ")\n";
  }
  return text;
}

} // namespace gnomon
