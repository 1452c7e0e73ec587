#include "protocol/base/config_text.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

bool isKey(std::string_view text) {
  const auto isAllowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), isAllowed);
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; ///< which some editors begin a file with

/// Reads a file from its first byte to its last.
class ConfigReader {
 public:
  ConfigReader(std::string_view text, std::string_view file) : text_(text), file_(file) {
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  ConfigText read() {
    while (at_ < text_.size() && read_.problems.size() < kMostProblems) {
      skipSpaces();
      if (!atLineEnd() && text_[at_] != '[') {
        readEntry();
      } else if (!atLineEnd() && !readName()) {
        read_.sections.push_back({line_, {}, {}}); // its keys are not those of the section before it
      }
      skipLine();
    }
    return std::move(read_);
  }

 private:
  static constexpr std::size_t kMostProblems = 20;

  bool ends() const { return at_ >= text_.size(); }
  bool atLineEnd() const { return ends() || text_[at_] == '\n' || text_[at_] == '#'; }

  void skipSpaces() {
    while (!ends() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }

  void skipLine() {
    while (!ends() && text_[at_] != '\n') ++at_;
    if (!ends()) ++at_;
    ++line_;
  }

  /// Between the values of a list: line ends and comments, too.
  void skipBetween() {
    for (skipSpaces(); !ends() && atLineEnd(); skipSpaces()) skipLine();
  }

  bool fail(std::string detail) {
    read_.problems.push_back(invalidValue(std::string(file_) + ":" + std::to_string(line_), std::move(detail)));
    return false;
  }

  bool readName() {
    const std::size_t end = text_.find_first_of("]\n", at_);
    if (end == std::string_view::npos || text_[end] != ']') return fail("The name of the section has no closing ].");
    const std::string name(trimmed(text_.substr(at_ + 1, end - at_ - 1)));
    const auto parts = split(name, '.');
    if (!std::all_of(parts.begin(), parts.end(), isKey))
      return fail("This is no section's name: " + asciiExcerpt(name) + ".");
    at_ = end + 1;
    skipSpaces();
    if (!atLineEnd()) return fail("Something follows the name of the section.");
    auto& sections = read_.sections;
    const auto known =
        std::find_if(sections.begin(), sections.end(), [&](const ConfigSection& each) { return each.name == name; });
    if (known != sections.end()) {
      return fail("The section " + name + " begins twice; first in line " + std::to_string(known->line) + ".");
    }
    sections.push_back({line_, name, {}});
    return true;
  }

  bool readEntry() {
    const std::size_t end = std::min(text_.find_first_of("=\n#", at_), text_.size());
    const std::string key(trimmed(text_.substr(at_, end - at_)));
    if (end == text_.size() || text_[end] != '=') return fail("This is not KEY = VALUE.");
    if (!isKey(key)) return fail("This is no key: " + asciiExcerpt(key) + ".");
    at_ = end + 1;
    ConfigEntry entry{line_, key, {}, false};
    skipSpaces();
    if (!ends() && text_[at_] == '[') {
      entry.isList = true;
      ++at_;
      if (!readList(entry)) return false;
    } else if (auto value = readValue()) {
      entry.values.push_back(*std::move(value));
    } else {
      return false;
    }
    skipSpaces();
    if (!atLineEnd()) return fail("Something follows the value of " + key + ". Texts with spaces need quotes.");
    auto& entries = read_.sections.back().entries;
    const auto known =
        std::find_if(entries.begin(), entries.end(), [&](const ConfigEntry& each) { return each.key == key; });
    if (known != entries.end()) return fail(key + " is set twice; first in line " + std::to_string(known->line) + ".");
    entries.push_back(std::move(entry));
    return true;
  }

  bool readList(ConfigEntry& entry) {
    for (skipBetween(); !ends() && text_[at_] != ']'; skipBetween()) {
      auto value = readValue();
      if (!value) return false;
      entry.values.push_back(*std::move(value));
      skipBetween();
      if (!ends() && text_[at_] == ',') {
        ++at_;
      } else if (!ends() && text_[at_] != ']') {
        return fail("The values of a list need commas between them.");
      }
    }
    if (ends())
      return fail("The list of " + entry.key + ", which began in line " + std::to_string(entry.line) + ", has no end.");
    ++at_;
    return true;
  }

  std::optional<std::string> readValue() {
    const char quote = ends() ? '\0' : text_[at_];
    if (quote == '"' || quote == '\'') return readQuoted(quote);
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n#,[]\"'=", at_), text_.size());
    if (end == at_) {
      fail("Here is no value.");
      return std::nullopt;
    }
    std::string word(text_.substr(at_, end - at_));
    at_ = end;
    return word;
  }

  std::optional<std::string> readQuoted(char quote) {
    std::string value;
    for (++at_; !ends() && text_[at_] != '\n' && text_[at_] != quote; ++at_) {
      if (quote == '\'' || text_[at_] != '\\') {
        value += text_[at_];
        continue;
      }
      const char escaped = ++at_ < text_.size() ? text_[at_] : '\n';
      constexpr std::string_view kNames = "\"\\nt", kMeanings = "\"\\\n\t";
      const std::size_t which = kNames.find(escaped);
      if (which == std::string_view::npos) {
        fail(R"(In "..." a backslash begins \", \\, \n or \t; in '...' it is one.)");
        return std::nullopt;
      }
      value += kMeanings[which];
    }
    if (ends() || text_[at_] != quote) {
      fail("The text has no closing quote.");
      return std::nullopt;
    }
    ++at_;
    return value;
  }

  std::string_view text_;
  std::string_view file_;
  std::size_t at_ = 0;
  int line_ = 1;
  ConfigText read_;
};

} // namespace

ConfigText parseSections(std::string_view text, std::string_view file) {
  if (isUtf8(text) && text.find('\0') == std::string_view::npos) return ConfigReader(text, file).read();
  ConfigText nothing;
  nothing.problems.push_back(invalidValue(std::string(file), "This is no text in UTF-8."));
  return nothing;
}

ConfigEntries parseConfig(std::string_view text, std::string_view file) {
  ConfigText read = parseSections(text, file);
  ConfigEntries all{{}, std::move(read.problems)};
  for (ConfigSection& section : read.sections) {
    if (section.line > 0) {
      all.problems.push_back(invalidValue(std::string(file) + ":" + std::to_string(section.line),
                                          "There are no sections here: every line is KEY = VALUE."));
    }
    std::move(section.entries.begin(), section.entries.end(), std::back_inserter(all.entries));
  }
  return all;
}

std::string configValue(std::string_view value) {
  const bool isNumber = !value.empty() && value.size() < 19 && (value == "0" || value[0] != '0') &&
                        value.find_first_not_of("0123456789") == std::string_view::npos;
  if (isNumber || value == "true" || value == "false") return std::string(value);
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? "\\n" : c == '\t' ? "\\t" : std::string(1, c);
  }
  return quoted + '"';
}

std::string configList(std::span<const std::string> values) {
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + configValue(value);
  return "[" + list + "]";
}

} // namespace gnomon
