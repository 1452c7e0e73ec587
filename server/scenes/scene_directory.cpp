#include "server/scenes/scene_directory.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include "protocol/base/bytes.h"
#include "server/scenes/whole_file.h"
#include "server/system/log.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBundle = ".bundle";
constexpr const char* kSummary = ".json";
constexpr const char* kDamaged = ".damaged";
constexpr std::size_t kMaxSummaryBytes = 16 << 20;

/// By errno.
Problem diskProblem(const char* what) {
  const int reason = errno;
  logEvent("store", std::string(what) + " " + std::error_code(reason, std::generic_category()).message() + ".");
  if (reason == ENOSPC || reason == EDQUOT) {
    return {ProblemCode::insufficientStorage, "", "The disk of the scene store is full.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The scene store can't read or write its disk.", "", ""};
}

/// Those whose bundle is gone: a server ended between removing the two.
void removeOrphanSummaries(const std::string& path) {
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const bool isSummary = entry->path().extension() == kSummary && isSceneId(entry->path().stem().string());
    std::error_code ignored; // another process may be removing it too
    if (isSummary && !fs::exists(fs::path(entry->path()).replace_extension(kBundle), ignored)) {
      fs::remove(entry->path(), ignored);
    }
  }
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

Result<SceneDirectory> SceneDirectory::open(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error) || ::access(path.c_str(), R_OK | W_OK | X_OK) != 0) {
    return Problem{ProblemCode::unavailable, "/store", "The scene store is not a writable directory.", "", path};
  }
  removeUnfinished(path);
  removeOrphanSummaries(path);
  return SceneDirectory(path);
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

StoreUse SceneDirectory::use() const {
  StoreUse use;
  for (const std::string& id : ids()) {
    std::error_code gone; // another process may have removed it
    const std::uintmax_t bytes = fs::file_size(pathOf(id, kBundle), gone);
    if (gone) continue;
    ++use.scenes;
    use.bytes += bytes;
  }
  return use;
}

bool SceneDirectory::contains(const std::string& id) const {
  return ::access(pathOf(id, kBundle).c_str(), R_OK) == 0;
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
  return FileDescriptor(::open(pathOf(id, kBundle).c_str(), O_RDONLY | O_CLOEXEC));
}

void SceneDirectory::setAside(const std::string& id) const {
  logEvent("store", "The stored bytes of scene " + id + " do not match its id. They are set aside.");
  ::rename(pathOf(id, kBundle).c_str(), pathOf(id, kDamaged).c_str());
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
  if (removed && !syncDirectory(path_)) {
    diskProblem("A removal may not outlive a power cut.");
  }
  return removed;
}

} // namespace gnomon
