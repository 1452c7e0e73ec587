#include "clients/cli/terminal/problem_text.h"

#include <algorithm>
#include <iostream>

#include "clients/cli/commands/commands.h"

namespace gnomon::cli {
namespace {

/// The flag that set this place or something that holds it.
std::string originOf(std::string pointer, const FlagOrigins& origins) {
  while (!pointer.empty()) {
    if (const auto found = origins.find(pointer); found != origins.end()) return found->second;
    const auto slash = pointer.rfind('/');
    if (slash == std::string::npos) break;
    pointer.erase(slash);
  }
  return "";
}

} // namespace

std::string problemLine(const Problem& problem, const FlagOrigins& origins) {
  std::string line;
  const std::string flag = originOf(problem.pointer, origins);
  if (!flag.empty()) line += flag + " (" + problem.pointer + "): ";
  if (flag.empty() && !problem.pointer.empty()) line += problem.pointer + ": ";
  line += problem.detail;
  if (!problem.limit.empty()) line += " Allowed: " + problem.limit + ".";
  if (!problem.actual.empty()) line += " Got: " + problem.actual + ".";
  return printable(line);
}

int printProblems(const Problems& problems, const FlagOrigins& origins) {
  for (const Problem& problem : problems) std::cerr << "gnomon: " << problemLine(problem, origins) << '\n';
  return kExitProblem;
}

std::string printable(std::string text) {
  const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), isControl, '?');
  return text;
}

} // namespace gnomon::cli
