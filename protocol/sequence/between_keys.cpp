#include "protocol/sequence/between_keys.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/base/text.h"
#include "protocol/fields/value_type.h"
#include "protocol/sun/moment.h"

namespace gnomon {
namespace {

using Kind = ValueType::Kind;

/// What is known of a value. A null type = it is no field of a spec.
struct Known {
  const ValueType* type = nullptr;
  bool isTime = false;
};

/// Of a struct's member.
Known memberOf(const StructType& type, std::string_view key) {
  for (const FieldType& field : type.fields) {
    if (!field.inlined && field.name == key) return {field.type, field.notes->isTime};
    const ValueType* inner = field.type->kind == Kind::optional ? field.type->element : field.type;
    if (!field.inlined || inner->object == nullptr) continue;
    if (const Known found = memberOf(*inner->object, key); found.type != nullptr) return found;
  }
  return {};
}

/// Without the optionals around it.
const ValueType* bare(const ValueType* type) {
  while (type != nullptr && type->kind == Kind::optional) type = type->element;
  return type;
}

std::string shown(const Json& value) {
  return asciiExcerpt(jsonText(value));
}

std::optional<Moment> timeOf(const Json& value) {
  if (!value.is_string()) return std::nullopt;
  const auto moment = readMoment(value.get_ref<const std::string&>());
  return moment ? std::optional(*moment) : std::nullopt;
}

void check(const Json& a, const Json& b, const Known& known, const Place& place, ProblemList& problems) {
  const ValueType* type = bare(known.type);
  if (a.is_object() && b.is_object()) {
    const StructType* object = type != nullptr ? type->object : nullptr;
    for (const auto& [key, value] : a.items()) {
      const Place inner(place, key);
      if (b.contains(key)) {
        check(value, b[key], object != nullptr ? memberOf(*object, key) : Known{}, inner, problems);
      } else {
        problems.add(
            invalidValue(inner.pointer(), "The key before has this field, so this one needs it, too.", shown(value)));
      }
    }
    for (const auto& [key, value] : b.items()) {
      if (a.contains(key)) continue;
      problems.add(
          invalidValue(Place(place, key).pointer(),
                       "Neither the spec nor the key before has this field, so there is nothing to interpolate "
                       "from.",
                       "", shown(value)));
    }
    return;
  }
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    const bool holds = type != nullptr && (type->kind == Kind::array || type->kind == Kind::list);
    for (std::size_t i = 0; i < a.size(); ++i) {
      check(a[i], b[i], {holds ? type->element : nullptr}, Place(place, i), problems);
    }
    return;
  }
  if (a == b || (a.is_number() && b.is_number() && type != nullptr && type->kind == Kind::number)) return;
  if (known.isTime && timeOf(a) && timeOf(b)) return;
  const bool numbers = a.is_number() && b.is_number();
  problems.add(invalidValue(place.pointer(),
                            numbers
                                ? "A whole number can't be interpolated; neighbouring keys must have the same."
                                : "Only numbers and times are interpolated; neighbouring keys must agree in all else.",
                            shown(a), shown(b)));
}

} // namespace

Json between(const Json& a, const Json& b, double t) {
  if (t == 0) return a;
  if (t == 1) return b;
  if (a.is_number() && b.is_number()) {
    if (a == b) return a;
    return std::lerp(a.get<double>(), b.get<double>(), t);
  }
  // No other texts differ: checkNeighbours refuses them.
  if (a.is_string() && a != b) return momentText(momentBetween(timeOf(a).value(), timeOf(b).value(), t));
  Json result = a;
  if (a.is_object()) {
    for (auto& [key, value] : result.items()) value = between(value, b[key], t);
  } else if (a.is_array()) {
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = between(a[i], b[i], t);
  }
  return result;
}

void checkNeighbours(const Json& a, const Json& b, const Place& place, ProblemList& problems) {
  check(a, b, {&typeOf<FrameSpec>()}, place, problems);
}

} // namespace gnomon
