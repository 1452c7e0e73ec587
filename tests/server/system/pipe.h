#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "server/system/file_descriptor.h"

namespace gnomon {

struct Pipe {
  Pipe() {
    int fds[2];
    EXPECT_EQ(::pipe2(fds, O_CLOEXEC), 0);
    reading = FileDescriptor(fds[0]);
    writing = FileDescriptor(fds[1]);
  }

  /// Everything until the writing side is closed.
  std::string readAll() {
    std::string all;
    char bytes[4096];
    for (ssize_t count = 0; (count = ::read(reading.get(), bytes, sizeof bytes)) > 0;) {
      all.append(bytes, static_cast<std::size_t>(count));
    }
    return all;
  }

  FileDescriptor reading, writing;
};

} // namespace gnomon
