#include "clients/cli/files/file_io.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <unistd.h>

#include "clients/cli/files/new_file.h"
#include "protocol/spec/format_traits.h"

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

std::optional<std::string> formatOf(const std::string& output) {
  const std::string suffix = std::filesystem::path(output).extension();
  if (suffix.empty()) return std::nullopt;
  for (const FormatTraits& traits : kFormatTraits) {
    if (suffix == traits.suffix || suffix == traits.otherSuffix) return std::string(spell(traits.format));
  }
  return std::nullopt;
}

std::string suffixList() {
  std::string list;
  for (const FormatTraits& traits : kFormatTraits) {
    for (const std::string_view suffix : {traits.suffix, traits.otherSuffix}) {
      if (!suffix.empty()) list.append(list.empty() ? "" : " ").append(suffix);
    }
  }
  return list;
}

std::string checkPictureName(const std::string& output) {
  return formatOf(output) ? "" : "needs a name that ends in one of " + suffixList();
}

std::string pictureFile(const std::string& output, const std::string& view, std::size_t pictureCount) {
  constexpr std::string_view kView = "{view}";
  if (const auto at = output.find(kView); at != std::string::npos) {
    return std::string(output).replace(at, kView.size(), view);
  }
  if (pictureCount == 1) return output;
  std::filesystem::path path(output);
  const std::string suffix = path.extension();
  return path.replace_extension(view + suffix);
}

Result<std::vector<std::string>> writePictures(const std::vector<Picture>& pictures, const std::string& output) {
  if (output == "-" && pictures.size() > 1) {
    return Problem{ProblemCode::invalidValue, "--output", "Standard output takes one picture.", "1",
                   std::to_string(pictures.size())};
  }
  std::vector<std::string> names;
  for (const Picture& picture : pictures) {
    names.push_back(pictureFile(output, picture.view, pictures.size()));
    if (auto written = writeFile(names.back(), picture.file); !written) return written.problems();
  }
  return names;
}

} // namespace gnomon::cli
