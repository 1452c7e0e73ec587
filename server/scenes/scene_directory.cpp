#include "server/scenes/scene_directory.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "protocol/base/bytes.h"
#include "protocol/base/scene_id.h"
#include "server/scenes/file_use.h"
#include "server/scenes/scene_backend.h"
#include "server/scenes/whole_file.h"
#include "server/system/log.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBundle = ".bundle";
constexpr const char* kSummary = ".json";
constexpr const char* kDamaged = ".damaged";

/// The id in "<id><ending>"; empty where the name is another one.
std::string_view idIn(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending)) return {};
  name.remove_suffix(ending.size());
  return isSceneId(name) ? name : std::string_view();
}

/// By errno.
Problem diskProblem(const char* what) {
  const int reason = errno;
  logEvent("store", std::string(what) + " " + std::error_code(reason, std::generic_category()).message() + ".");
  if (reason == ENOSPC || reason == EDQUOT) {
    return {ProblemCode::insufficientStorage, "", "The disk of the scene store is full.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The scene store can't read or write its disk.", "", ""};
}

/// A file's bytes, piece by piece.
void copyBytes(const FileDescriptor& file, const FileSink& sink) {
  Bytes piece(1 << 20);
  off_t at = 0;
  ssize_t count = 0;
  while ((count = ::pread(file.get(), piece.data(), piece.size(), at)) > 0) {
    sink(std::span(piece).first(static_cast<std::size_t>(count)));
    at += count;
  }
}

} // namespace

std::string SceneDirectory::pathOf(const std::string& id, const char* ending) const {
  return path_ + "/" + id + ending;
}

SceneDirectory::SceneDirectory(std::string path, std::chrono::seconds age) : path_(std::move(path)) {
  constexpr std::chrono::milliseconds kUsual = std::chrono::minutes(1);
  constexpr int kShare = 10;
  resolution_ =
      age.count() > 0 ? std::min<std::chrono::milliseconds>(kUsual, std::chrono::milliseconds(age) / kShare) : kUsual;
}

Result<SceneDirectory> SceneDirectory::open(const std::string& path, std::chrono::seconds age) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error) || ::access(path.c_str(), R_OK | W_OK | X_OK) != 0) {
    return Problem{ProblemCode::unavailable, "/store", "The scene store is not a writable directory.", "", path};
  }
  SceneDirectory directory(path, age);
  directory.cleanUp();
  return directory;
}

ScenePage SceneDirectory::page(std::string_view after, std::size_t limit) const {
  PageFinder finder(after, limit);
  eachName(path_, [&](std::string_view name) {
    if (const auto id = idIn(name, kBundle); !id.empty()) finder.see(id);
  });
  return std::move(finder).page();
}

StoreSize SceneDirectory::size(const std::multiset<std::string>& without) const {
  StoreSize size;
  eachName(path_, [&](std::string_view name) {
    const std::string id(idIn(name, kBundle));
    const bool isScene = !id.empty();
    if (isScene && without.contains(id)) return;
    struct stat status {};
    if ((!isScene && idIn(name, kDamaged).empty()) || ::stat((path_ + "/").append(name).c_str(), &status) != 0) return;
    size.scenes += isScene ? 1 : 0;
    size.bytes += static_cast<std::uint64_t>(status.st_size);
  });
  return size;
}

std::uint64_t SceneDirectory::bytesOf(const std::string& id) const {
  struct stat status {};
  return ::stat(pathOf(id, kBundle).c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

bool SceneDirectory::contains(const std::string& id) const {
  // Opening looks the name up again where a shared file system would answer access(2) from its cache.
  const FileDescriptor file(::open(pathOf(id, kBundle).c_str(), O_RDONLY | O_CLOEXEC));
  return file || (errno != ENOENT && errno != EACCES && errno != ESTALE);
}

Status SceneDirectory::write(const std::string& id, const FileDescriptor& bundle, const std::string& summary) const {
  // The bundle first: no summary is ever left without one.
  if (!placeFile(pathOf(id, kBundle), [&](const FileSink& sink) { copyBytes(bundle, sink); }) ||
      !syncDirectory(path_)) {
    return diskProblem("A scene could not be written.");
  }
  writeSummary(id, summary);
  return Done{};
}

void SceneDirectory::writeSummary(const std::string& id, const std::string& summary) const {
  if (!placeFile(pathOf(id, kSummary), [&](const FileSink& sink) { sink(asBytes(summary)); })) {
    diskProblem("A summary could not be written.");
  }
}

FileDescriptor SceneDirectory::openBundle(const std::string& id) const {
  return openUsed(pathOf(id, kBundle), resolution_);
}

void SceneDirectory::setAside(const std::string& id) const {
  logEvent("store", "The stored bytes of scene " + id + " do not match its id. They are set aside.");
  ::rename(pathOf(id, kBundle).c_str(), pathOf(id, kDamaged).c_str());
}

std::optional<std::string> SceneDirectory::readSummary(const std::string& id) const {
  const auto bytes = readWhole(pathOf(id, kSummary), SceneBackend::kMaxSummaryBytes);
  if (!bytes) return std::nullopt;
  return std::string(bytes->begin(), bytes->end());
}

bool SceneDirectory::remove(const std::string& id) const {
  const bool removed = ::unlink(pathOf(id, kBundle).c_str()) == 0;
  ::unlink(pathOf(id, kSummary).c_str());
  if (removed && !syncDirectory(path_)) diskProblem("A removal may not outlive a power cut.");
  return removed;
}

void SceneDirectory::cleanUp() const {
  removeUnfinished(path_);
  eachName(path_, [&](std::string_view name) { // removals end with the summary, and a server may have ended before
    const std::string id(idIn(name, kSummary));
    if (!id.empty() && !contains(id)) ::unlink(pathOf(id, kSummary).c_str());
  });
}

void SceneDirectory::removeUnused(std::chrono::seconds age,
                                  const std::function<void(const std::string& id)>& removed) const {
  bool any = false;
  eachName(path_, [&](std::string_view name) {
    const std::string id(idIn(name, kBundle));
    const bool isBundle = !id.empty();
    if (!isBundle && idIn(name, kDamaged).empty()) return;
    if (!removeIfUnused((path_ + "/").append(name), age)) return;
    any = true;
    if (!isBundle) return;
    ::unlink(pathOf(id, kSummary).c_str());
    removed(id);
  });
  if (any) syncDirectory(path_);
}

} // namespace gnomon
