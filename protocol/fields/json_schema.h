#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "protocol/fields/value_type.h"

/// JSON Schema (2020-12, as OpenAPI 3.1 has it) from the rows. A described struct becomes one of the components, by
/// its name, and is referred to.
namespace gnomon {

/// What a value's type is made into; `components` receives the structs that it refers to.
Json schemaOf(const ValueType& type, const Notes& notes, Json& components);

template <class T>
Json schemaOf(const Notes& notes, Json& components) {
  return schemaOf(typeOf<T>(), notes, components);
}

/// The row's sentence and unit, and what the words of an enum mean, or of an enum in an optional or a list.
std::string describe(const Notes& notes, const ValueType& type);

} // namespace gnomon
