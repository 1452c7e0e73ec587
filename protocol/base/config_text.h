#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"

/// Configuration files as text: one KEY = VALUE a line, which TOML reads, too.
namespace gnomon {

/// One line's key, and its value or the values of its list.
struct ConfigEntry {
  int line = 0; ///< from 1
  std::string key;
  std::vector<std::string> values;
  bool isList = false;
};

/// The entries below a [NAME] line; of a file's first section, which has no name, those above all such lines.
struct ConfigSection {
  int line = 0; ///< of the name; 0 of the first
  std::string name;
  std::vector<ConfigEntry> entries;
};

/// The entries of a file without sections, each key once. A value is a "text" with the escapes \" \\ \n \t, a 'text'
/// without any, a bare word (a number, true, 512MB), or a list of those in brackets, which may take several lines. #
/// begins a comment. Problems: one for each line that is none of these, with the place "FILE:LINE" as its pointer.
Result<std::vector<ConfigEntry>> parseConfig(std::string_view text, std::string_view file);

/// The sections of a file, the one without a name first, each name once; in a section each key once. A name is keys
/// with dots between. Problems: as above.
Result<std::vector<ConfigSection>> parseSections(std::string_view text, std::string_view file);

/// A value as parseConfig reads it back.
std::string configValue(std::string_view value);
std::string configList(std::span<const std::string> values);

} // namespace gnomon
