#include "server/metrics/process_use.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace gnomon::metrics {
namespace {

/// Seconds since 1970 at which the machine started: btime of /proc/stat.
double machineStart() {
  std::ifstream file("/proc/stat");
  double seconds = 0;
  for (std::string word; file >> word;) {
    if (word == "btime") {
      file >> seconds;
      break;
    }
  }
  return seconds;
}

std::uint64_t entriesOf(const char* directory) {
  std::error_code error;
  std::uint64_t count = 0;
  for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    ++count;
  }
  return count;
}

} // namespace

ProcessUse processUse() {
  // Fields of /proc/self/stat after the program's name in brackets, which may hold anything; the first of them is 3.
  constexpr std::size_t kUser = 14 - 3, kSystem = 15 - 3, kThreads = 20 - 3, kStart = 22 - 3, kVirtual = 23 - 3,
                        kResident = 24 - 3, kFields = 22;
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::array<double, kFields> fields{};
  if (const std::size_t name = text.rfind(')'); name != std::string::npos) {
    std::istringstream rest(text.substr(name + 1));
    std::string state;
    rest >> state;
    for (std::size_t i = 1; i < kFields && rest; ++i) rest >> fields[i];
  }
  static const double kTicks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  static const double kBoot = machineStart();
  ProcessUse use;
  use.residentBytes = static_cast<std::uint64_t>(fields[kResident] * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  use.virtualBytes = static_cast<std::uint64_t>(fields[kVirtual]);
  use.threads = static_cast<std::uint64_t>(fields[kThreads]);
  use.processorSeconds = (fields[kUser] + fields[kSystem]) / kTicks;
  use.startSeconds = kBoot + fields[kStart] / kTicks;
  use.openFiles = entriesOf("/proc/self/fd");
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) use.mostFiles = files.rlim_cur;
  return use;
}

} // namespace gnomon::metrics
