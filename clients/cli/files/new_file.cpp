#include "clients/cli/files/new_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace gnomon::cli {

bool writeAll(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

namespace {

/// The folder that a file is to be in, and those around it.
Status makeFolderOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (!error) return Done{};
  return Problem{ProblemCode::invalidValue, path,
                 "The folder " + folder.string() + " can't be made: " + error.message() + ".", "", ""};
}

} // namespace

Result<NewFile> NewFile::create(const std::string& path) {
  if (auto made = makeFolderOf(path); !made) return made.problems();
  std::string temporary = path + ".XXXXXX";
  const int file = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (file < 0) return Problem{ProblemCode::invalidValue, path, std::string(std::strerror(errno)) + ".", "", ""};
  return NewFile(path, std::move(temporary), file);
}

NewFile::NewFile(NewFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      file_(std::exchange(other.file_, -1)) {}

NewFile::~NewFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Problem NewFile::failed(int error) const {
  return {ProblemCode::invalidValue, path_, std::string(std::strerror(error)) + ".", "", ""};
}

Status NewFile::write(std::span<const std::uint8_t> bytes) {
  if (!writeAll(file_, bytes)) return failed(errno);
  return Done{};
}

Status NewFile::finish() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(file_, 0666 & ~mask) != 0) return failed(errno);
  if (::close(std::exchange(file_, -1)) != 0) return failed(errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failed(errno);
  temporary_.clear();
  return Done{};
}

} // namespace gnomon::cli
