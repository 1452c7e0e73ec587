#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/bytes.h"

/// A model, the files that it names, and their names.
namespace gnomon {

/// An uploaded model and the files that it names.
struct SceneBundle {
  Bytes model;                        ///< a GLB or glTF JSON
  std::map<std::string, Bytes> files; ///< by the name that the model uses, percent-decoded; never a path upwards
  bool strict = false;                ///< refused where it violates glTF, instead of repaired
};

/// Whether this is what a server calls a scene: the SHA-256 of its upload, 64 lower-case hexadecimal digits.
inline bool isSceneId(std::string_view text) {
  const auto isDigit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() == 64 && std::all_of(text.begin(), text.end(), isDigit);
}

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
