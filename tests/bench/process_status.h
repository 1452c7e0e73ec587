#pragma once

#include <fstream>
#include <string>

namespace gnomon::bench {

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
