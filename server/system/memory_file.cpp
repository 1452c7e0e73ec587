#include "server/system/memory_file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace gnomon {

MemoryFileWriter::MemoryFileWriter()
    : file_(::memfd_create("gnomon", MFD_CLOEXEC | MFD_ALLOW_SEALING)), whole_(bool(file_)) {}

void MemoryFileWriter::add(std::span<const std::uint8_t> bytes) {
  while (whole_ && !bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else {
      whole_ = written < 0 && errno == EINTR;
    }
  }
}

std::optional<FileDescriptor> MemoryFileWriter::finish() {
  constexpr int kSeals = F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;
  if (!whole_ || ::fcntl(file_.get(), F_ADD_SEALS, kSeals) != 0) return std::nullopt;
  whole_ = false;
  return std::move(file_);
}

std::optional<FileDescriptor> memoryFile(std::span<const std::uint8_t> bytes) {
  MemoryFileWriter writer;
  writer.add(bytes);
  return writer.finish();
}

std::optional<std::size_t> sizeOf(const FileDescriptor& file) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || status.st_size < 0) return std::nullopt;
  return static_cast<std::size_t>(status.st_size);
}

namespace {

template <class Content>
std::optional<Content> contentOf(const FileDescriptor& file, std::size_t most) {
  const auto size = sizeOf(file);
  if (!size || *size > most) return std::nullopt;
  Content content(*size, {});
  std::size_t count = 0;
  while (count < content.size()) {
    const ssize_t got = ::pread(file.get(), content.data() + count, content.size() - count, static_cast<off_t>(count));
    if (got == 0 || (got < 0 && errno != EINTR)) return std::nullopt;
    if (got > 0) count += static_cast<std::size_t>(got);
  }
  return content;
}

} // namespace

std::optional<Bytes> readFile(const FileDescriptor& file, std::size_t most) {
  return contentOf<Bytes>(file, most);
}

std::optional<std::string> readText(const FileDescriptor& file, std::size_t most) {
  return contentOf<std::string>(file, most);
}

} // namespace gnomon
