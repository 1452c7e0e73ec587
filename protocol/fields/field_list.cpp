#include "protocol/fields/field_list.h"

#include <algorithm>
#include <set>

#include "protocol/fields/field_checks.h"
#include "protocol/fields/json_schema.h"
#include "protocol/spec/field_rows.h"

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

/// The words for a member's type.
template <class T>
struct TypeText {
  static std::string make() {
    if constexpr (std::is_same_v<T, bool>) return "true | false";
    if constexpr (std::is_same_v<T, int>) return "whole number";
    if constexpr (std::is_same_v<T, double>) return "number";
    if constexpr (std::is_same_v<T, std::string>) return "string";
    if constexpr (Spelled<T>) return joined(kSpellings<T>);
    if constexpr (Described<T>) return std::string(kRows<T>.name);
  }
};
template <class T>
struct TypeText<std::optional<T>> : TypeText<T> {};
template <>
struct TypeText<std::variant<int, std::string>> {
  static std::string make() { return "whole number or string"; }
};
template <std::size_t kSize>
struct TypeText<std::array<double, kSize>> {
  static std::string make() { return std::to_string(kSize) + " numbers"; }
};
template <class T>
struct TypeText<std::vector<T>> {
  static std::string make() { return "list of " + TypeText<T>::make(); }
};

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T>
struct IsList<std::optional<T>> : IsList<T> {};

/// The struct that a member leads to, through optionals and lists; void = it holds a value.
template <class T>
using Inner = std::conditional_t<Described<typename Unwrapped<T>::Type>, typename Unwrapped<T>::Type, void>;

/// The names of the structs that are reached from T without passing through a list.
template <Described T>
void collectOutsideLists(std::set<std::string_view>& names) {
  names.insert(kRows<T>.name);
  forEachField<T>([&]<class F>(const F&) {
    using Member = typename F::Member;
    if constexpr (!std::is_void_v<Inner<Member>> && !IsList<Member>::value) collectOutsideLists<Inner<Member>>(names);
  });
}

Notes withoutUnit(Notes notes) {
  notes.unit = {};
  return notes;
}

class FieldWalk {
 public:
  FieldWalk() { collectOutsideLists<FrameSpec>(outsideLists_); }

  template <Described T>
  void walk(const std::string& prefix, bool inList, bool absent) {
    forEachField<T>([&]<class F>(const F& field) {
      using Member = typename F::Member;
      const std::string path = prefix + std::string(field.name);
      if constexpr (kIsOptionalStruct<Member>) {
        if (field.inlined) return walk<Inner<Member>>(prefix, inList, true);
      }
      if constexpr (!std::is_void_v<Inner<Member>>) {
        if (!inList || !outsideLists_.contains(kRows<Inner<Member>>.name)) {
          const bool list = IsList<Member>::value;
          return walk<Inner<Member>>(path + (list ? "[]." : "."), inList || list, false);
        }
      }
      std::string preset;
      if constexpr (!kIsOptional<Member>) {
        if (!absent) preset = encodeValue(T{}.*field.member).dump();
      }
      Json components = Json::object();
      Json schema = schemaOf<Member>(field.notes, components);
      if (!preset.empty()) schema["default"] = Json::parse(preset);
      if (!schema.contains("$ref")) schema["description"] = describe(field.notes, spellingsIn<Member>());
      entries_.push_back({path, TypeText<Member>::make(), rangeText(field.notes), std::string(field.notes.unit), preset,
                          describe(withoutUnit(field.notes), spellingsIn<Member>()), std::move(schema)});
    });
  }

  std::vector<FieldEntry> take() && { return std::move(entries_); }

 private:
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
  FieldWalk walk;
  walk.walk<FrameSpec>("", false, false);
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
