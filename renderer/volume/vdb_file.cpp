#include "renderer/volume/vdb_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "renderer/core/stop.h"
#include "renderer/volume/vdb/vdb_program.h"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

/// An open file, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

/// A child, killed and waited for at the end.
class Child : public VdbProcess {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() override {
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    wait();
  }

  int wait() override {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

/// The first that exists; nothing where none does.
std::optional<std::filesystem::path> firstOf(const std::vector<std::filesystem::path>& programs) {
  std::error_code ignored;
  const auto found =
      std::ranges::find_if(programs, [&](const auto& path) { return std::filesystem::exists(path, ignored); });
  return found == programs.end() ? std::nullopt : std::optional(*found);
}

/// Where this program's own may lie; none where it is unknown.
std::vector<std::filesystem::path> ownPrograms() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::vector<std::filesystem::path>() : vdbProgramPaths(executable);
}

/// What startVdbBy was given.
StartVdb& starter() {
  static StartVdb start = vdbAsChild(ownPrograms());
  return start;
}

Problem unusable(const std::string& why) {
  return {ProblemCode::internal, "", "The reader of VDB files is not usable: " + why + "."};
}

Descriptor memoryFileOf(std::span<const std::uint8_t> bytes) {
  Descriptor file(memfd_create("gnomon_vdb", MFD_CLOEXEC));
  while (file.number() >= 0 && !bytes.empty()) {
    const ssize_t written = write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return Descriptor();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (file.number() >= 0) lseek(file.number(), 0, SEEK_SET);
  return file;
}

enum class Received { whole, less, late };

/// Fills `bytes` as far as the other side gives any before the deadline.
Received receive(const Descriptor& from, std::span<std::uint8_t> bytes, Clock::time_point deadline) {
  while (!bytes.empty()) {
    constexpr std::chrono::milliseconds kAskAgain{20};
    stopIfAsked();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return Received::late;
    pollfd waiting{from.number(), POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::min(left, kAskAgain).count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    if (ready < 0) return Received::late;
    const ssize_t count = read(from.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Received::less;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return Received::whole;
}

template <class T>
std::span<std::uint8_t> bytesOf(std::span<T> numbers) {
  return {reinterpret_cast<std::uint8_t*>(numbers.data()), numbers.size_bytes()};
}

Problem problemOf(int outcome, const std::string& names) {
  switch (outcome) {
    case vdb::noSuchGrid:
      return {ProblemCode::invalidValue, "",
              "The .vdb file has no float grid of this name, or one of several must be named.",
              names.empty() ? "none" : names};
    case vdb::empty:
      return {ProblemCode::invalidValue, "", "The grid of the .vdb file has no active voxel."};
    case vdb::tooLarge:
      return {ProblemCode::tooLarge, "", "The .vdb file takes too much memory to read.",
              std::to_string(vdb::kMaxMemoryBytes) + " bytes"};
    default:
      return {ProblemCode::malformed, "", "The .vdb file is no VDB file, or it is broken."};
  }
}

/// Why less came than belongs to a reply.
Problem problemOf(Received received, VdbProcess& process, std::chrono::milliseconds deadline) {
  if (received == Received::late) {
    return {ProblemCode::tooLarge, "", "The .vdb file takes too long to read.",
            std::to_string(deadline.count()) + " ms"};
  }
  const int status = process.wait();
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : vdb::broken;
  // As a shell and the dynamic linker end.
  if (code == 126 || code == 127)
    return unusable(std::string(vdb::kProgram) + " or a library that it needs cannot be opened");
  if (code == vdb::unsealed)
    return unusable("the system does not let " + std::string(vdb::kProgram) + " give up its rights");
  return problemOf(code, {});
}

} // namespace

namespace {

std::unique_ptr<VdbProcess> startAsChild(const std::filesystem::path& program, const std::string& name, int input,
                                         int output) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  std::string path = program.string(), text = name;
  std::array<char*, 3> arguments{path.data(), text.data(), nullptr};
  std::array<char*, 1> environment{nullptr};
  pid_t child = -1;
  const int error = posix_spawn(&child, path.c_str(), &files, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return error == 0 ? std::make_unique<Child>(child) : nullptr;
}

} // namespace

StartVdb vdbAsChild(std::vector<std::filesystem::path> programs) {
  return
      [programs = std::move(programs)](const std::string& name, int input, int output) -> std::unique_ptr<VdbProcess> {
        const auto program = firstOf(programs);
        return program ? startAsChild(*program, name, input, output) : nullptr;
      };
}

void startVdbBy(StartVdb start) {
  starter() = std::move(start);
}

std::optional<std::filesystem::path> ownVdbProgram() {
  return firstOf(ownPrograms());
}

bool isGridName(std::string_view name) {
  constexpr std::size_t kMostBytes = 4 * 255; // 255 characters
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; };
  return name.size() <= kMostBytes && std::ranges::none_of(name, isControl);
}

std::vector<std::filesystem::path> vdbProgramPaths(const std::filesystem::path& executable) {
  const std::filesystem::path folder = executable.parent_path();
  return {folder / vdb::kProgram, (folder / ".." / "lib" / "gnomon" / vdb::kProgram).lexically_normal()};
}

Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name, const StartVdb& start,
                            std::chrono::milliseconds deadline) {
  if (!isGridName(name)) {
    return Problem{ProblemCode::invalidValue, "", "The name of a grid has no control characters.", "1..255 characters"};
  }
  const Clock::time_point end = Clock::now() + deadline;
  const Descriptor input = memoryFileOf(file);
  std::array<int, 2> ends{-1, -1};
  if (input.number() < 0 || pipe2(ends.data(), O_CLOEXEC) != 0)
    return unusable("there are no more files or no more memory");
  const Descriptor output(ends[0]);
  Descriptor written(ends[1]);
  const auto process = start(name, input.number(), written.number());
  if (!process)
    return unusable(std::string(vdb::kProgram) +
                    " can't be started; it belongs beside the program, or in ../lib/gnomon");
  written = Descriptor();

  vdb::Reply reply;
  Received received = receive(output, bytesOf(std::span(&reply, 1)), end);
  if (received != Received::whole) return problemOf(received, *process, deadline);
  if (reply.outcome != vdb::grid) {
    std::string names(static_cast<std::size_t>(std::clamp(reply.nameBytes, 0, vdb::kMaxNameBytes)), ' ');
    received = receive(output, bytesOf(std::span(names)), end);
    return received == Received::whole ? problemOf(reply.outcome, names) : problemOf(received, *process, deadline);
  }
  const auto count = voxelCount(reply.voxels[0], reply.voxels[1], reply.voxels[2]);
  if (!count) return count.problems();
  DensityGrid grid{glm::ivec3(reply.voxels[0], reply.voxels[1], reply.voxels[2]), std::vector<float>(*count)};
  received = receive(output, bytesOf(std::span(grid.values)), end);
  if (received != Received::whole) return problemOf(received, *process, deadline);
  return requireFinite(std::move(grid));
}

Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name) {
  return readVdb(file, name, starter());
}

} // namespace gnomon
