#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// What the `uri` of a buffer or an image says of a file.
struct FileUri {
  std::string path; ///< as it is written, percent-decoded, with '/' for '\' and without "file://"
  /// The file's name in a bundle: plain folders and a name with '/' between them. What leads upwards from the model's
  /// folder begins with "_up" for each step, an absolute path with "_root".
  std::string name;
  bool isOutside = false;    ///< of the model's folder
  bool hasBackslash = false; ///< which glTF does not allow
};

/// Nothing where the URI is a data: URI or an address of another scheme, has a broken escape or a control character, or
/// names no file.
std::optional<FileUri> fileUri(std::string_view uri);

} // namespace gnomon
