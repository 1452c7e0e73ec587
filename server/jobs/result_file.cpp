#include "server/jobs/result_file.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

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

ResultFile::ResultFile(const std::string& directory) : file_(openUnnamed(directory)) {}

std::optional<std::uint64_t> ResultFile::add(std::span<const std::uint8_t> bytes) {
  const std::uint64_t begin = end_.fetch_add(bytes.size());
  std::uint64_t at = begin;
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return std::nullopt;
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
