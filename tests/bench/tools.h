#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "renderer/evaluation/evaluation_measures.h"
#include "tests/support/files.h"

namespace gnomon::bench {

inline std::string rounded(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
  testing::writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// Each call once a round, in turn, so that noise meets all; a first round, which warms up, does not count. Medians.
inline std::vector<double> mediansInTurns(int rounds, const std::vector<std::function<double(int round)>>& calls) {
  std::vector<std::vector<double>> times(calls.size());
  for (int round = 0; round <= rounds; ++round) {
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const double time = calls[i](round);
      if (round > 0) times[i].push_back(time);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& each : times) medians.push_back(median(std::move(each)));
  return medians;
}

/// A line of a process's status, proc(5), in bytes: "VmRSS:" is memory in use, "VmHWM:" the most since its start or the
/// last reset. `process`: a number, or "self". 0 = there is no such line.
inline double statusBytes(const std::string& process, const std::string& line) {
  std::ifstream status("/proc/" + process + "/status");
  std::string word;
  double kibibytes = 0;
  while (status >> word) {
    if (word == line && status >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

} // namespace gnomon::bench
