#include "server/scenes/directory_backend.h"

#include "server/system/log.h"

namespace gnomon {

DirectoryBackend::DirectoryBackend(SceneDirectory directory, std::uint64_t quotaBytes, std::chrono::seconds age)
    : age_(age),
      directory_(std::move(directory)),
      quota_(quotaBytes, [this](const auto& without) { return directory_.size(without).bytes; }) {}

Result<std::unique_ptr<SceneBackend>> DirectoryBackend::open(const std::string& path, std::uint64_t quotaBytes,
                                                             std::chrono::seconds age) {
  auto opened = SceneDirectory::open(path, age);
  if (!opened) return std::move(opened).problems();
  return std::unique_ptr<SceneBackend>(new DirectoryBackend(*std::move(opened), quotaBytes, age));
}

Result<bool> DirectoryBackend::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes,
                                   const std::string& summary) {
  if (use(id)) return false;
  const Status written = quota_.write(id, bytes, [&] { return directory_.write(id, *bundle, summary); });
  if (!written) return written.problems();
  return true;
}

Result<StoredBundle> DirectoryBackend::bundle(const std::string& id) {
  auto file = std::make_shared<FileDescriptor>(directory_.openBundle(id));
  if (*file) return StoredBundle{std::move(file), true};
  if (!directory_.contains(id)) return unknownScene(id);
  return Problem{ProblemCode::unavailable, "", "The scene store can't read its disk.", "", ""};
}

Status DirectoryBackend::contains(const std::string& id) {
  if (!directory_.contains(id)) return unknownScene(id);
  return Done{};
}

Status DirectoryBackend::use(const std::string& id) {
  const auto opened = bundle(id);
  if (!opened) return opened.problems();
  return Done{};
}

void DirectoryBackend::keepSummary(const std::string& id, const std::string& summary) {
  directory_.writeSummary(id, summary);
}

Status DirectoryBackend::remove(const std::string& id) {
  const std::uint64_t bytes = directory_.bytesOf(id);
  if (!directory_.remove(id)) return unknownScene(id);
  quota_.giveBack(bytes);
  return Done{};
}

void DirectoryBackend::keepClean(const SceneListener& removed) {
  directory_.cleanUp();
  if (age_.count() > 0) directory_.removeUnused(age_, removed);
}

} // namespace gnomon
