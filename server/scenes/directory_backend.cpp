#include "server/scenes/directory_backend.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/scene_bundle.h"
#include "server/scenes/removal_delay.h"
#include "server/scenes/store_quota.h"
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

/// By errno: what was named is not there, or is there no longer.
bool isGone() {
  return errno == ENOENT || errno == ESTALE;
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

/// How exactly the time of a scene's last use is kept.
std::chrono::milliseconds resolutionFor(std::chrono::seconds age) {
  constexpr std::chrono::milliseconds kUsual = std::chrono::minutes(1);
  constexpr int kShare = 10;
  return age.count() > 0 ? std::min<std::chrono::milliseconds>(kUsual, std::chrono::milliseconds(age) / kShare)
                         : kUsual;
}

/// Bundles on disk, one file each, named by id: "<id>.bundle", beside it "<id>.json" with the summary's text.
/// Files appear by rename only, so that a crash leaves a whole file or none. A bundle's time of change says when its
/// scene was used last, and each process that has it open holds a shared lock on it (flock), so that all that share the
/// directory agree on what is in use.
class DirectoryBackend final : public SceneBackend {
 public:
  DirectoryBackend(std::string path, std::uint64_t quotaBytes, std::chrono::seconds age)
      : path_(std::move(path)),
        age_(age),
        resolution_(resolutionFor(age)),
        delay_(age),
        quota_(quotaBytes, [this](const auto& without) { return sizeWithout(without).bytes; }) {}

  Status checkRoom(std::uint64_t bytes) override { return quota_.check(bytes); }

  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) override {
    if (use(id)) return false;
    const Status written = quota_.write(id, bytes, [&] { return write(id, *bundle, summary); });
    if (!written) return written.problems();
    return true;
  }

  /// While the file is open, no server removes the scene for its age.
  Result<StoredBundle> bundle(const std::string& id) override {
    auto file = std::make_shared<FileDescriptor>(openUsed(pathOf(id, kBundle), resolution_));
    if (*file) return StoredBundle{std::move(file), true};
    if (const Status there = contains(id); !there) return there.problems();
    return diskProblem("A scene could not be read.");
  }

  Status contains(const std::string& id) override {
    if (openBundle(id)) return Done{};
    if (isGone()) return missing(id);
    return diskProblem("A scene could not be read.");
  }

  Status use(const std::string& id) override {
    const auto opened = bundle(id);
    if (!opened) return opened.problems();
    return Done{};
  }

  Result<ScenePage> page(std::string_view after, std::size_t limit) override {
    PageFinder finder(after, limit);
    const bool isRead = eachName(path_, [&](std::string_view name) {
      if (const auto id = idIn(name, kBundle); !id.empty()) finder.see(id);
    });
    if (!isRead) return diskProblem("The scenes could not be listed.");
    return std::move(finder).page();
  }

  StoreSize size() override { return sizeWithout({}); }

  StoreState state() override {
    StoreState state;
    state.isReachable = isReachable();
    return state;
  }

  std::optional<std::string> summary(const std::string& id) override {
    const FileDescriptor file = openRegular(pathOf(id, kSummary), O_RDONLY);
    return file ? readText(file, kMaxSummaryBytes) : std::nullopt;
  }

  void keepSummary(const std::string& id, const std::string& summary) override {
    if (!placeFile(pathOf(id, kSummary), [&](const FileSink& sink) { sink(asBytes(summary)); })) {
      diskProblem("A summary could not be written.");
    }
  }

  /// Renamed to "<id>.damaged"; uploading the scene again repairs it.
  void setAside(const std::string& id) override {
    logEvent("store", "The stored bytes of scene " + id + " do not match its id. They are set aside.");
    const bool moved = ::rename(pathOf(id, kBundle).c_str(), pathOf(id, kDamaged).c_str()) == 0;
    if (!moved && !isGone()) diskProblem("They could not be set aside.");
  }

  Status remove(const std::string& id) override {
    struct stat status {};
    const bool isKnown = ::stat(pathOf(id, kBundle).c_str(), &status) == 0;
    if (::unlink(pathOf(id, kBundle).c_str()) != 0) {
      if (!isGone()) return diskProblem("A scene could not be removed.");
      ::unlink(pathOf(id, kSummary).c_str());
      return missing(id);
    }
    ::unlink(pathOf(id, kSummary).c_str());
    if (!syncDirectory(path_)) diskProblem("A removal may not outlive a power cut.");
    quota_.giveBack(isKnown ? static_cast<std::uint64_t>(status.st_size) : 0);
    return Done{};
  }

  void keepClean(const SceneListener& removed) override {
    cleanUp();
    if (age_.count() > 0) removeUnused(removed);
  }

  void onRemoved(SceneListener) override {} ///< shared file systems send no notice: each use looks

  /// Removes what servers that died have left: unfinished files, and summaries without a bundle.
  void cleanUp() const {
    removeUnfinished(path_);
    eachName(path_, [&](std::string_view name) { // removals end with the summary, and a server may have ended before
      const std::string id(idIn(name, kSummary));
      if (!id.empty() && !openBundle(id) && isGone()) ::unlink(pathOf(id, kSummary).c_str());
    });
  }

 private:
  std::string pathOf(const std::string& id, const char* ending) const { return path_ + "/" + id + ending; }

  bool isReachable() const {
    return static_cast<bool>(FileDescriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)));
  }

  /// Of a scene without a bundle, in a directory that may be away itself.
  Problem missing(const std::string& id) const {
    return isReachable() ? unknownScene(id) : diskProblem("The directory is away.");
  }

  /// Opening looks the name up again where a shared file system would answer access(2) from its cache.
  FileDescriptor openBundle(const std::string& id) const { return openRegular(pathOf(id, kBundle), O_RDONLY); }

  /// Reads the whole directory; damaged bundles have bytes, too. `without`: scenes whose bundles don't count. While the
  /// directory can't be read: what was counted last.
  StoreSize sizeWithout(const StoreQuota::SceneIds& without) {
    StoreSize size;
    const bool isRead = eachName(path_, [&](std::string_view name) {
      const std::string id(idIn(name, kBundle));
      const bool isScene = !id.empty();
      if (isScene && without.contains(id)) return;
      struct stat status {};
      const bool isCounted = isScene || !idIn(name, kDamaged).empty();
      if (!isCounted || ::stat((path_ + "/").append(name).c_str(), &status) != 0) return;
      size.scenes += isScene ? 1 : 0;
      size.bytes += static_cast<std::uint64_t>(status.st_size);
    });
    const std::lock_guard lock(counting_);
    if (isRead) counted_ = size;
    return counted_;
  }

  /// Through to the disk, the bundle first: no summary is ever left without one. Nothing is left where the disk
  /// refuses.
  Status write(const std::string& id, const FileDescriptor& bundle, const std::string& summary) {
    if (!placeFile(pathOf(id, kBundle), [&](const FileSink& sink) { eachPiece(bundle, sink); }) ||
        !syncDirectory(path_)) {
      return diskProblem("A scene could not be written.");
    }
    keepSummary(id, summary);
    return Done{};
  }

  /// Scenes, each of which is reported, and bundles set aside as long ago.
  void removeUnused(const SceneListener& removed) {
    std::size_t all = 0;
    std::vector<std::string> unused;
    eachName(path_, [&](std::string_view name) {
      if (idIn(name, kBundle).empty() && idIn(name, kDamaged).empty()) return;
      ++all;
      if (isUnused((path_ + "/").append(name), age_)) unused.emplace_back(name);
    });
    if (!delay_.mayGo(unused.size(), all, Clock::now())) return;
    bool any = false;
    for (const std::string& name : unused) {
      if (!removeIfUnused(path_ + "/" + name, age_)) continue;
      any = true;
      const std::string id(idIn(name, kBundle));
      if (id.empty()) continue;
      ::unlink(pathOf(id, kSummary).c_str());
      removed(id);
    }
    if (any) syncDirectory(path_);
  }

  const std::string path_;
  const std::chrono::seconds age_;
  const std::chrono::milliseconds resolution_; ///< of the time of a scene's last use
  RemovalDelay delay_;
  std::mutex counting_;
  StoreSize counted_{}; ///< the last time
  StoreQuota quota_;
};

} // namespace

Result<std::unique_ptr<SceneBackend>> openSceneDirectory(const std::string& path, std::uint64_t quotaBytes,
                                                         std::chrono::seconds age) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error) || ::access(path.c_str(), R_OK | W_OK | X_OK) != 0) {
    return Problem{ProblemCode::unavailable, "/store", "The scene store is not a writable directory.", "", path};
  }
  auto directory = std::make_unique<DirectoryBackend>(path, quotaBytes, age);
  directory->cleanUp();
  return std::unique_ptr<SceneBackend>(std::move(directory));
}

} // namespace gnomon
