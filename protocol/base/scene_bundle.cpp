#include "protocol/base/scene_bundle.h"

#include <algorithm>
#include <vector>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

/// Of "file://host/path": what follows the host, which is the computer itself.
std::string_view pathOfFileUri(std::string_view uri) {
  constexpr std::string_view kAuthority = "//";
  uri.remove_prefix(std::string_view("file:").size());
  if (!uri.starts_with(kAuthority)) return uri;
  uri.remove_prefix(kAuthority.size());
  uri.remove_prefix(std::min(uri.find('/'), uri.size()));
  return uri;
}

std::vector<std::string> segmentsOf(std::string_view path) {
  std::vector<std::string> segments;
  while (true) {
    const std::size_t slash = path.find('/');
    if (const std::string_view segment = path.substr(0, slash); !segment.empty() && segment != ".") {
      segments.emplace_back(segment);
    }
    if (slash == std::string_view::npos) return segments;
    path.remove_prefix(slash + 1);
  }
}

} // namespace

std::optional<FileUri> fileUri(std::string_view uri) {
  const std::string scheme = schemeOf(uri);
  if (!scheme.empty() && scheme != "file") return std::nullopt;
  auto decoded = percentDecoded(scheme.empty() ? uri : pathOfFileUri(uri));
  const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (!decoded || std::ranges::any_of(*decoded, isControl)) return std::nullopt;

  FileUri file;
  file.path = *std::move(decoded);
  file.hasBackslash = file.path.find('\\') != std::string::npos;
  std::ranges::replace(file.path, '\\', '/');
  const bool isAbsolute = file.path.starts_with('/');
  std::vector<std::string> kept;
  std::size_t up = 0;
  for (std::string& segment : segmentsOf(file.path)) {
    if (segment != "..") {
      kept.push_back(std::move(segment));
    } else if (!kept.empty()) {
      kept.pop_back();
    } else if (!isAbsolute) {
      ++up;
    }
  }
  if (kept.empty()) return std::nullopt;
  file.isOutside = isAbsolute || up > 0;
  if (isAbsolute) file.name = "_root/";
  for (std::size_t i = 0; i < up; ++i) file.name += "_up/";
  for (std::size_t i = 0; i < kept.size(); ++i) file.name += (i == 0 ? "" : "/") + kept[i];
  return file;
}

} // namespace gnomon
