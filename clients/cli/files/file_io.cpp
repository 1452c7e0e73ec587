#include "clients/cli/files/file_io.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace gnomon::cli {
namespace {

Problem fileProblem(ProblemCode code, const std::string& path, const std::string& detail) {
  return {code, path, detail + ".", "", ""};
}

Problem tooLarge(const std::string& path, std::size_t maxBytes, const std::string& actual) {
  return {ProblemCode::tooLarge, path, "The file is too large.", std::to_string(maxBytes) + " bytes", actual};
}

} // namespace

Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    return fileProblem(ProblemCode::notFound, path.string(), "There is no such file");
  if (!std::filesystem::is_regular_file(status)) {
    return fileProblem(ProblemCode::invalidValue, path.string(), "This is not a file");
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error) return fileProblem(ProblemCode::notFound, path.string(), error.message());
  if (size > maxBytes) return tooLarge(path.string(), maxBytes, std::to_string(size) + " bytes");

  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    return fileProblem(ProblemCode::notFound, path.string(), "The file can't be read");
  }
  return bytes;
}

Result<Bytes> readStandardInput(std::size_t maxBytes) {
  constexpr std::size_t kPiece = 1 << 16;
  Bytes bytes;
  while (true) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kPiece);
    const ssize_t read = ::read(STDIN_FILENO, bytes.data() + size, kPiece);
    bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return fileProblem(ProblemCode::notFound, "standard input", std::strerror(errno));
    if (bytes.size() > maxBytes) return tooLarge("standard input", maxBytes, "more");
    if (read == 0) return bytes;
  }
}

Result<std::string> readText(const std::string& path, std::size_t maxBytes) {
  if (path != "-") {
    auto bytes = readFile(path, maxBytes);
    if (!bytes) return bytes.problems();
    return std::string(bytes->begin(), bytes->end());
  }
  auto bytes = readStandardInput(maxBytes);
  if (!bytes) return bytes.problems();
  return std::string(bytes->begin(), bytes->end());
}

Status writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
  if (path == "-") {
    if (writeAll(STDOUT_FILENO, bytes)) return Done{};
    return fileProblem(ProblemCode::internal, "standard output", std::strerror(errno));
  }
  auto file = NewFile::create(path);
  if (!file) return file.problems();
  if (auto written = file->write(bytes); !written) return written;
  return file->finish();
}

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
  return invalidValue(path, "The folder " + folder.string() + " can't be made: " + error.message() + ".");
}

} // namespace

Result<NewFile> NewFile::create(const std::string& path) {
  if (auto made = makeFolderOf(path); !made) return made.problems();
  std::string temporary = path + ".XXXXXX";
  const int file = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (file < 0) return invalidValue(path, std::string(std::strerror(errno)) + ".");
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
  return invalidValue(path_, std::string(std::strerror(error)) + ".");
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
