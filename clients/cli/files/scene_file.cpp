#include "clients/cli/files/scene_file.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "clients/cli/files/file_io.h"
#include "clients/cli/files/gltf_uris.h"
#include "protocol/base/encoding.h"

namespace gnomon::cli {
namespace {

/// A relative path of plain names: no scheme, root, drive, backslash, NUL or "..".
bool isPlainRelative(const std::string& name) {
  if (name.empty() || name.find_first_of(std::string_view("\\:\0", 3)) != std::string::npos) return false;
  const std::filesystem::path path(name);
  return path.is_relative() && std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
}

bool isInside(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

/// Where the name leads, when that is inside the folder.
std::optional<std::filesystem::path> resolve(const std::filesystem::path& folder, const std::string& name) {
  if (!isPlainRelative(name)) return std::nullopt;
  std::error_code error;
  const auto root = std::filesystem::canonical(folder, error);
  if (error) return std::nullopt;
  const auto file = std::filesystem::weakly_canonical(root / name, error);
  if (error || !isInside(root, file)) return std::nullopt;
  return file;
}

} // namespace

Result<SceneBundle> readSceneFile(const std::filesystem::path& path, const Limits& limits) {
  auto model = readFile(path, limits.maxSceneBytes);
  if (!model) return model.problems();
  SceneBundle bundle;
  bundle.model = std::move(*model);

  const auto uris = externalUris(bundle.model);
  if (uris.size() > limits.maxBundleFiles) {
    return Problem{ProblemCode::tooLarge, path.string(), "The model names too many files.",
                   std::to_string(limits.maxBundleFiles), std::to_string(uris.size())};
  }
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::size_t room = limits.maxSceneBytes - bundle.model.size();
  Problems problems;
  for (const std::string& uri : uris) {
    const auto name = percentDecoded(uri);
    const auto file = name ? resolve(folder, *name) : std::nullopt;
    if (!file) {
      problems.push_back({ProblemCode::invalidScene, path.string(),
                          "The model names a file that isn't inside its folder.",
                          "a relative name without \"..\" or a scheme", uri.substr(0, 200)});
      continue;
    }
    auto bytes = readFile(*file, room);
    if (!bytes) {
      for (Problem problem : bytes.problems()) {
        problem.pointer = (folder / *name).string();
        problem.detail += " The model names it.";
        problems.push_back(std::move(problem));
      }
      continue;
    }
    room -= bytes->size();
    bundle.files[*name] = std::move(*bytes);
  }
  if (!problems.empty()) return problems;
  return bundle;
}

} // namespace gnomon::cli
