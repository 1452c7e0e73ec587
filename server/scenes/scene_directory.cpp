#include "server/scenes/scene_directory.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <span>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "protocol/base/bytes.h"
#include "server/http/request_log.h"
#include "server/http/socket_io.h"
#include "server/scenes/bundle.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBundle = ".bundle";
constexpr const char* kSummary = ".json";
constexpr const char* kDamaged = ".damaged";
constexpr std::string_view kTemporary = ".writing-";
constexpr std::size_t kMaxSummaryBytes = 16 << 20;

Problem diskProblem(const char* what) {
  logEvent("store", std::string(what) + " " + std::error_code(errno, std::generic_category()).message() + ".");
  return {ProblemCode::unavailable, "", "The scene store can't read or write its disk.", "", ""};
}

/// Calls `produce` with a function that appends to the file; false when the disk refuses.
using Sink = std::function<void(std::span<const std::uint8_t>)>;
bool writeThrough(const std::string& path, const std::function<void(const Sink&)>& produce) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0640));
  bool good = static_cast<bool>(file);
  produce([&](std::span<const std::uint8_t> bytes) {
    while (good && !bytes.empty()) {
      const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
      if (count > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(count));
      } else {
        good = count < 0 && errno == EINTR;
      }
    }
  });
  return good && ::fsync(file.get()) == 0;
}

std::optional<Bytes> readWhole(const std::string& path, std::size_t most) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<std::size_t>(status.st_size) > most) {
    return std::nullopt;
  }
  Bytes bytes(static_cast<std::size_t>(status.st_size));
  std::size_t read = 0;
  while (read < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + read, bytes.size() - read);
    if (count > 0) {
      read += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      return std::nullopt;
    }
  }
  return bytes;
}

/// Unique among the threads and processes that write into the directory.
std::string temporaryName() {
  static std::atomic<std::uint64_t> count{0};
  return std::string(kTemporary) + std::to_string(::getpid()) + "-" + std::to_string(++count);
}

bool syncDirectory(const std::string& path) {
  const FileDescriptor directory(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return directory && ::fsync(directory.get()) == 0;
}

/// Writes a file under another name and renames it, so that it appears whole. False, with errno, where the disk
/// refuses.
bool place(const std::string& path, const std::function<void(const Sink&)>& produce) {
  const std::string temporary = fs::path(path).parent_path() / temporaryName();
  if (writeThrough(temporary, produce) && ::rename(temporary.c_str(), path.c_str()) == 0) {
    return true;
  }
  const int reason = errno;
  ::unlink(temporary.c_str());
  errno = reason;
  return false;
}

} // namespace

std::string SceneDirectory::pathOf(const std::string& id, const char* ending) const {
  return path_ + "/" + id + ending;
}

Result<SceneDirectory> SceneDirectory::open(const std::string& path, std::size_t maxSceneBytes) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error) || ::access(path.c_str(), R_OK | W_OK | X_OK) != 0) {
    return Problem{ProblemCode::unavailable, "/store", "The scene store is not a writable directory.", "", path};
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().filename().string().starts_with(kTemporary)) {
      std::error_code ignored; // another process may be removing it too
      fs::remove(entry.path(), ignored);
    }
  }
  return SceneDirectory(path, maxSceneBytes);
}

std::vector<std::string> SceneDirectory::ids() const {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator entry(path_, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == kBundle && isSceneId(entry->path().stem().string())) {
      found.push_back(entry->path().stem().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool SceneDirectory::contains(const std::string& id) const {
  return ::access(pathOf(id, kBundle).c_str(), R_OK) == 0;
}

Status SceneDirectory::write(const std::string& id, const SceneBundle& bundle, const std::string& summary) const {
  // The bundle last: once it is there, the scene is.
  const bool written = place(pathOf(id, kSummary), [&](const Sink& sink) { sink(asBytes(summary)); }) &&
                       place(pathOf(id, kBundle), [&](const Sink& sink) { writeBundle(bundle, sink); }) &&
                       syncDirectory(path_);
  if (!written) {
    return diskProblem("A scene could not be written.");
  }
  return Done{};
}

void SceneDirectory::writeSummary(const std::string& id, const std::string& summary) const {
  if (!place(pathOf(id, kSummary), [&](const Sink& sink) { sink(asBytes(summary)); })) {
    diskProblem("A summary could not be written.");
  }
}

Result<SceneBundle> SceneDirectory::read(const std::string& id) const {
  constexpr std::size_t kFraming = 1 << 20; // names and lengths around the files
  auto bytes = readWhole(pathOf(id, kBundle), maxSceneBytes_ + kFraming);
  if (!bytes) {
    if (!contains(id)) {
      return Problem{ProblemCode::notFound, "id", "No scene with this id is stored.", "", id};
    }
    return diskProblem("A scene could not be read.");
  }
  auto bundle = readBundle(*std::move(bytes));
  if (!bundle || bundleId(*bundle) != id) {
    logEvent("store", "The stored bytes of scene " + id + " do not match its id. They are set aside.");
    ::rename(pathOf(id, kBundle).c_str(), pathOf(id, kDamaged).c_str());
    return Problem{ProblemCode::notFound, "id", "The stored bytes of this scene were damaged. Upload it again.", "",
                   id};
  }
  return bundle;
}

std::optional<std::string> SceneDirectory::readSummary(const std::string& id) const {
  const auto bytes = readWhole(pathOf(id, kSummary), kMaxSummaryBytes);
  if (!bytes) {
    return std::nullopt;
  }
  return std::string(bytes->begin(), bytes->end());
}

bool SceneDirectory::remove(const std::string& id) const {
  const bool removed = ::unlink(pathOf(id, kBundle).c_str()) == 0;
  ::unlink(pathOf(id, kSummary).c_str());
  return removed;
}

} // namespace gnomon
