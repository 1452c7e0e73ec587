#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"

namespace gnomon::cli {

/// The whole file, refused before reading when it is larger than `maxBytes`. Problems name `path` as the user gave it.
Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxBytes);

/// All of standard input, refused once it is larger than `maxBytes`.
Result<Bytes> readStandardInput(std::size_t maxBytes);

/// A file as text; "-" is standard input.
Result<std::string> readText(const std::string& path, std::size_t maxBytes);

/// Puts the file in place atomically: readers see the old file or the whole new one. Makes the folders that it
/// needs. "-" is standard output.
Status writeFile(const std::string& path, std::span<const std::uint8_t> bytes);

/// A file that is written piece by piece and put in place atomically: readers see the old file or the whole new
/// one, and nothing is left of one that is not finished. Problems name the path as the user gave it.
class NewFile {
 public:
  /// Makes the folders of the path that are not there.
  static Result<NewFile> create(const std::string& path);
  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;
  ~NewFile();

  Status write(std::span<const std::uint8_t> bytes);
  Status finish(); ///< once, as the last call

 private:
  NewFile(std::string path, std::string temporary, int file)
      : path_(std::move(path)), temporary_(std::move(temporary)), file_(file) {}
  Problem failed(int error) const;

  std::string path_;
  std::string temporary_; ///< beside the path, since a rename is one step only within a file system; empty = none
  int file_;              ///< -1 = closed
};

/// All of it to an open file; false with errno.
bool writeAll(int file, std::span<const std::uint8_t> bytes);

} // namespace gnomon::cli
