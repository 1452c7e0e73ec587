#include "server/process/environment_check.h"

#include <algorithm>
#include <array>
#include <unistd.h>
#include <utility>

#include "protocol/base/text.h"

namespace gnomon {
namespace {

constexpr std::string_view kPrefix = "GNOMON_";
constexpr std::array<std::string_view, 3> kProtocols{"TCP", "UDP", "SCTP"};
constexpr std::size_t kMostEdits = 2; ///< letters to insert, remove or replace in a name that is suggested

/// Those that only the Python client reads.
constexpr std::array<std::string_view, 2> kPythonVariables{"GNOMON_BINARY", "GNOMON_SERVER"};

/// What a flag's own name leads to -> the variable. GNOMON_PORT itself is a service's.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOtherNames{
    {{"GNOMON_PORT", "GNOMON_LISTEN_PORT"}, {"GNOMON_ADMIN_PORT", "GNOMON_ADMIN_LISTEN_PORT"}}};

bool isNumber(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool isProtocol(std::string_view text) {
  return std::find(kProtocols.begin(), kProtocols.end(), text) != kProtocols.end();
}

/// As "tcp://10.0.0.1:8080".
bool isAddress(std::string_view value) {
  const std::size_t end = value.find("://");
  std::string protocol(value.substr(0, end));
  std::transform(protocol.begin(), protocol.end(), protocol.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return end != std::string_view::npos && isProtocol(protocol);
}

/// What follows the service's name: its words, from `first` on.
bool isServiceEnding(const std::vector<std::string>& words, std::size_t first, std::string_view value) {
  const std::size_t count = words.size() - first;
  const auto word = [&](std::size_t i) { return std::string_view(words[first + i]); };
  if (count >= 2 && word(0) == "SERVICE") {
    return (count == 2 && word(1) == "HOST") || (word(1) == "PORT" && isNumber(value));
  }
  if (count == 0 || word(0) != "PORT") return false;
  if (count == 1) return isAddress(value);
  const bool isPort = count >= 3 && isNumber(word(1)) && isProtocol(word(2));
  return isPort && (count == 3 || (count == 4 && (word(3) == "PROTO" || word(3) == "PORT" || word(3) == "ADDR")));
}

/// The variable that may have been meant; empty where none is near.
std::string meantBy(std::string_view name, std::span<const std::string> known) {
  for (const auto& [other, variable] : kOtherNames) {
    if (name == other) return std::string(variable);
  }
  return nearestName(name, known, kMostEdits);
}

} // namespace

bool isServiceVariable(std::string_view name, std::string_view value) {
  const std::vector<std::string> words = split(name, '_');
  if (words.front() != "GNOMON") return false;
  for (std::size_t first = 1; first < words.size(); ++first) {
    if (isServiceEnding(words, first, value)) return true;
  }
  return false;
}

std::vector<std::string> unknownVariables(std::span<const std::string> environment,
                                          std::span<const std::string> known) {
  std::vector<std::string> faults;
  for (const std::string& entry : environment) {
    const std::size_t end = entry.find('=');
    const std::string name = entry.substr(0, end);
    if (!name.starts_with(kPrefix) || end == std::string::npos) continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (std::find(kPythonVariables.begin(), kPythonVariables.end(), name) != kPythonVariables.end()) continue;
    if (isServiceVariable(name, std::string_view(entry).substr(end + 1))) continue;
    const std::string meant = meantBy(name, known);
    faults.push_back("There is no environment variable " + asciiExcerpt(name) +
                     (meant.empty() ? "." : "; did you mean " + meant + "?"));
  }
  return faults;
}

std::vector<std::string> ownEnvironment() {
  std::vector<std::string> entries;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) entries.emplace_back(*entry);
  return entries;
}

} // namespace gnomon
