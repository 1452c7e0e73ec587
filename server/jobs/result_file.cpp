#include "server/jobs/result_file.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

#include "server/system/log.h"

namespace gnomon {
namespace {

FileDescriptor openUnnamed(const std::string& directory) {
  if (directory.empty()) return FileDescriptor(::memfd_create("gnomon-job", MFD_CLOEXEC));
  FileDescriptor file(::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (file) return file;
  std::string path = directory + "/job-XXXXXX"; // a file system that has no unnamed files
  FileDescriptor named(::mkostemp(path.data(), O_CLOEXEC));
  if (named) ::unlink(path.c_str());
  return named;
}

} // namespace

Problem refusedByDisk(int reason, ProblemCode otherwise) {
  logEvent("jobs", "The pictures of a job can't be kept: " + std::generic_category().message(reason) + ".");
  if (reason == ENOSPC || reason == EDQUOT || reason == ENOMEM) {
    return {ProblemCode::insufficientStorage, "", "What keeps the pictures of jobs is full: the disk, or memory.", "",
            ""};
  }
  return {otherwise, "", "What keeps the pictures of jobs refuses to be written: the disk, or memory.", "", ""};
}

Result<std::shared_ptr<ResultFile>> ResultFile::make(const std::string& directory) {
  FileDescriptor file = openUnnamed(directory);
  if (!file) return refusedByDisk(errno, ProblemCode::unavailable);
  return std::make_shared<ResultFile>(std::move(file));
}

Result<std::uint64_t> ResultFile::add(std::span<const std::uint8_t> bytes) {
  const std::uint64_t begin = end_.fetch_add(bytes.size());
  std::uint64_t at = begin;
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return refusedByDisk(written < 0 ? errno : ENOSPC, ProblemCode::internal);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
  return begin;
}

std::optional<Bytes> ResultFile::read(std::uint64_t offset, std::size_t size) const {
  Bytes bytes(size);
  if (!readAt(file_, offset, bytes)) return std::nullopt;
  return bytes;
}

} // namespace gnomon
