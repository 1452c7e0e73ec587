#pragma once

#include <nlohmann/json.hpp>

#include "protocol/fields/value_type.h"

/// Described structs to JSON: keys in the rows' order, absent fields left out.
namespace gnomon {

Json encodeValue(const ValueType& type, const void* value);

template <class T>
Json encodeValue(const T& value) {
  return encodeValue(typeOf<T>(), &value);
}

} // namespace gnomon
