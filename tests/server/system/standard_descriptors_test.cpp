#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "server/system/file_descriptor.h"

namespace gnomon {
namespace {

std::string fileOf(int fd) {
  std::array<char, 256> name;
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  const ssize_t length = ::readlink(link.c_str(), name.data(), name.size());
  return {name.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0))};
}

/// In a process that was started with these closed: whether nothing that it opens becomes one of 0 to 2.
bool staysClear(std::initializer_list<int> closed) {
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int fd : closed) ::close(fd);
    fillStandardDescriptors();
    bool isClear = StopSignal().fd() > STDERR_FILENO;
    for (const int fd : closed) isClear = isClear && fileOf(fd) == "/dev/null";
    ::_exit(isClear ? 0 : 1);
  }
  int status = 1;
  return ::waitpid(child, &status, 0) == child && status == 0;
}

TEST(StandardDescriptors, ThatAreClosedBecomeTheNullDevice) {
  EXPECT_TRUE(staysClear({}));
  for (const int fd : {0, 1, 2}) EXPECT_TRUE(staysClear({fd})) << fd;
  EXPECT_TRUE(staysClear({1, 2}));
  EXPECT_TRUE(staysClear({0, 1, 2}));
}

} // namespace
} // namespace gnomon
