#include "server/worker/vdb_starter.h"

#include <array>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "protocol/base/bytes.h"
#include "tests/renderer/volume/vdb_builder.h"

namespace gnomon {
namespace {

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    reading = FileDescriptor(ends[0]);
    writing = FileDescriptor(ends[1]);
  }
  FileDescriptor reading, writing;
};

std::unique_ptr<VdbStarter> starterOf(const std::string& program, std::uint64_t bytes = 0) {
  return VdbStarter::start({std::filesystem::path(program), bytes});
}

/// What a program writes until it ends, and how it ends.
std::pair<std::string, int> outputOf(VdbStarter& starter, const std::string& name) {
  Pipe in, out;
  const auto process = starter.startVdb(name, in.reading.get(), out.writing.get());
  if (!process) return {"", -1};
  out.writing.reset();
  std::string text;
  char byte = 0;
  while (::read(out.reading.get(), &byte, 1) == 1) text += byte;
  return {text, process->wait()};
}

constexpr int kStarters = 1, kReaders = 3; ///< the generations below this process; the second attends to readers

/// The processes so many generations below one.
std::vector<pid_t> below(int generations, pid_t process = ::getpid()) {
  if (generations == 0) return {process};
  std::vector<pid_t> found;
  std::error_code none;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task/", none)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child;) {
      for (const pid_t one : below(generations - 1, child)) found.push_back(one);
    }
  }
  return found;
}

std::map<std::string, std::string> rightsOf(pid_t process) {
  std::map<std::string, std::string> rights;
  std::ifstream lines("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(lines, line);) {
    if (const auto colon = line.find(":\t"); colon != std::string::npos)
      rights[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return rights;
}

/// Whether `holds` comes true within ten seconds.
bool soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 1000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(VdbStarter, StartsItsOwnProgramWhateverAMessageNames) {
  const auto starter = starterOf("/bin/echo");
  ASSERT_TRUE(starter);
  EXPECT_EQ(outputOf(*starter, "density"), std::pair(std::string("density\n"), 0));
  for (const std::string name : {"density\n/bin/sh", "density\n/bin/cat\n/bin/sh", "a\tb", "\x7f"}) {
    const auto [text, status] = outputOf(*starter, name);
    EXPECT_EQ(text, "") << name;
    EXPECT_NE(status, 0) << name;
  }
  EXPECT_EQ(outputOf(*starter, std::string("x\0y", 3)).first, "");
  EXPECT_EQ(outputOf(*starter, std::string(1021, 'x')).first, "");
  EXPECT_EQ(outputOf(*starter, std::string(40'000, 'x')).first, "") << "a text that comes as a file";
  EXPECT_EQ(outputOf(*starter, "/bin/sh").first, "/bin/sh\n") << "no more than a name";
  EXPECT_EQ(outputOf(*starter, "mass").first, "mass\n") << "it goes on";
}

TEST(VdbStarter, AProgramThatIsMissingEndsAsInAShell) {
  const auto starter = VdbStarter::start({});
  ASSERT_TRUE(starter);
  const int status = outputOf(*starter, "density").second;
  EXPECT_EQ(WEXITSTATUS(status), 127);
}

TEST(VdbStarter, ReadsGridsAndTheReaderIsSealedAsSoonAsItReads) {
  const auto starter = starterOf(GNOMON_VDB, 100 << 20);
  ASSERT_TRUE(starter);
  const StartVdb start = [&](const std::string& name, int in, int out) { return starter->startVdb(name, in, out); };
  const std::string file = vdbFile({{"density", {{{0, 0, 0}, 1}, {{1, 0, 0}, 2}}}});
  for (int i = 0; i < 3; ++i) {
    const auto grid = readVdb(asBytes(file), "density", start);
    ASSERT_TRUE(grid) << grid.problems().front().detail;
    EXPECT_THAT(grid->values, testing::ElementsAre(1, 2));
  }

  Pipe in, out; // nothing is written into it: the reader waits
  auto process = starter->startVdb("density", in.reading.get(), out.writing.get());
  std::vector<pid_t> readers;
  ASSERT_TRUE(soon([&] {
    readers = below(kReaders);
    return readers.size() == 1 && rightsOf(readers[0])["Seccomp_filters"] == "2";
  }));
  auto rights = rightsOf(readers[0]);
  EXPECT_EQ(rights["Seccomp"], "2");
  EXPECT_EQ(rights["NoNewPrivs"], "1");
  for (const char* capabilities : {"CapEff", "CapPrm", "CapInh"}) {
    EXPECT_EQ(rights[capabilities], "0000000000000000") << capabilities;
  }
  std::error_code closed; // to all users but root
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(readers[0]) + "/fd", closed)) {
    EXPECT_LT(std::stoi(entry.path().filename()), 3) << "the file, the pipe, /dev/null";
  }
  process.reset();
  EXPECT_TRUE(soon([&] { return below(kReaders).empty(); })) << "it ends with its caller";
  EXPECT_TRUE(readVdb(asBytes(file), "density", start)) << "the next one starts";
}

TEST(VdbStarter, AGridThatTakesMoreMemoryThanIsPlannedIsTooLarge) {
  VdbGrid scattered{"wide", {}}; // leaves of 512 voxels: 30,000 of them take 60 MB
  for (int i = 0; i < 30'000; ++i) scattered.voxels.push_back({{8 * (i % 200), 8 * (i / 200), 0}, 1});
  const std::string file = vdbFile({scattered});
  const auto read = [&](std::uint64_t planned) {
    const auto starter = starterOf(GNOMON_VDB, planned);
    return readVdb(asBytes(file), "wide",
                   [&](const std::string& name, int in, int out) { return starter->startVdb(name, in, out); });
  };
  EXPECT_TRUE(read(100 << 20));
  const auto grid = read(30 << 20);
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.problems().front().code, ProblemCode::tooLarge);
}

TEST(VdbStarter, IsSealedItself) {
  const auto starter = starterOf("/bin/echo");
  ASSERT_EQ(outputOf(*starter, "density").first, "density\n");
  const auto starters = below(kStarters); // those of earlier cases may be about to end
  ASSERT_FALSE(starters.empty());
  auto rights = rightsOf(starters.back());
  EXPECT_EQ(rights["Seccomp"], "2");
  EXPECT_EQ(rights["NoNewPrivs"], "1");
  EXPECT_EQ(rights["CapEff"], "0000000000000000");
}

} // namespace
} // namespace gnomon
