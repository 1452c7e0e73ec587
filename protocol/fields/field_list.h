#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/json/json_source.h"

/// The fields of a frame's specification one by one, for documentation and query strings.
namespace gnomon {

/// One field, as the rows describe it.
struct FieldEntry {
  std::string path;    ///< dotted; "[]" after the name of a list: "lights[].sun.azimuthDegrees"
  std::string type;    ///< "number", "whole number", "color | depth", "3 numbers", ...
  std::string allowed; ///< "1..8192"; empty = whatever the type allows
  std::string unit;    ///< empty = none
  std::string preset;  ///< the default as JSON; empty = absent
  std::string says;    ///< what it does, and what each of its values means
  Json schema;         ///< without references
};

/// Every field that holds a value rather than further fields, in the order of the rows. A struct in a list
/// and outside of it, too (a light's own shadow), is taken apart only outside.
std::vector<FieldEntry> frameFields();

/// The table of FIELDS.md: a Markdown head and one row a field.
std::string fieldTable();

/// The same as plain text for a terminal, one field a line.
std::string fieldHelp();

} // namespace gnomon
