#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/fields/field_codec.h"

namespace gnomon {
namespace {

Json encodeObject(const StructType& type, const void* owner) {
  Json object = Json::object();
  for (const FieldType& field : type.fields) {
    const void* member = field.member(owner);
    if (field.type->kind == ValueType::Kind::optional && field.type->size(member) == 0) continue;
    Json value = encodeValue(*field.type, member);
    if (field.inlined) {
      object.update(value);
    } else {
      object[std::string(field.name)] = std::move(value);
    }
  }
  return object;
}

} // namespace

Json encodeValue(const ValueType& type, const void* value) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      return valueAs<bool>(value);
    case Kind::integer:
      return valueAs<int>(value);
    case Kind::integer64:
      return valueAs<std::int64_t>(value);
    case Kind::unsigned64:
      return valueAs<std::uint64_t>(value);
    case Kind::number:
      return valueAs<double>(value);
    case Kind::text:
      return asUtf8(valueAs<std::string>(value));
    case Kind::indexOrName: {
      const auto& either = valueAs<std::variant<int, std::string>>(value);
      if (const int* index = std::get_if<int>(&either)) return *index;
      return asUtf8(std::get<std::string>(either));
    }
    case Kind::word:
      return std::string(type.spellings[static_cast<std::size_t>(type.wordIndex(value))].name);
    case Kind::optional:
      return type.size(value) == 0 ? Json() : encodeValue(*type.element, type.at(value, 0));
    case Kind::array:
    case Kind::list: {
      Json array = Json::array();
      for (std::size_t i = 0; i < type.size(value); ++i) array.push_back(encodeValue(*type.element, type.at(value, i)));
      return array;
    }
    case Kind::object:
      return encodeObject(*type.object, value);
    case Kind::custom:
      return type.custom->encode(value);
  }
  return {};
}

} // namespace gnomon
