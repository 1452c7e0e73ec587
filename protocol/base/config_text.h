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

/// What a text has, beside the lines that are wrong. A problem's pointer is the place, "FILE:LINE".
struct ConfigText {
  std::vector<ConfigSection> sections{1}; ///< the one without a name first, each name once
  Problems problems{};
};
struct ConfigEntries {
  std::vector<ConfigEntry> entries{};
  Problems problems{};
};

/// The sections of a file; in a section each key once. A name is keys with dots between. A value is a "text" with the
/// escapes \" \\ \n \t, a 'text' without any, a bare word (a number, true, 512MB), or a list of those in brackets,
/// which may take several lines. # begins a comment. Problems: one for each line that is none of these, up to 20.
ConfigText parseSections(std::string_view text, std::string_view file);

/// The entries of a file that is to have no sections: a problem for each that it has.
ConfigEntries parseConfig(std::string_view text, std::string_view file);

/// A value as parseConfig reads it back.
std::string configValue(std::string_view value);
std::string configList(std::span<const std::string> values);

} // namespace gnomon
