#include "clients/cli/files/scene_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "clients/cli/files/file_io.h"
#include "protocol/base/bytes.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

/// The JSON text: of a GLB its first chunk, else the bytes themselves.
std::string_view jsonText(std::span<const std::uint8_t> model) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const std::string_view text = asText(model);
  if (!text.starts_with("glTF")) return text;
  if (model.size() < kHeader + kChunkHeader) return {};
  const std::uint64_t length = littleEndian(model.subspan(kHeader, 4));
  if (length > model.size() - kHeader - kChunkHeader) return {};
  return text.substr(kHeader + kChunkHeader, length);
}

/// Follows the JSON event by event and keeps the strings at /buffers/N/uri and /images/N/uri.
class UriCollector : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::vector<std::string> uris;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= kLimits.maxJsonDepth; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ <= kLimits.maxJsonDepth; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  bool key(string_t& name) override {
    if (depth_ == 1) inList_ = name == "buffers" || name == "images";
    isUri_ = inList_ && depth_ == 3 && name == "uri";
    return true;
  }

  bool string(string_t& value) override {
    const bool wanted = isUri_ && depth_ == 3 && !value.starts_with("data:");
    if (wanted && std::find(uris.begin(), uris.end(), value) == uris.end()) uris.push_back(std::move(value));
    return true;
  }

 private:
  int depth_ = 0;       // 1 = inside the root object, 3 = inside an element of a list
  bool inList_ = false; // under /buffers or /images
  bool isUri_ = false;  // the last key was an element's uri
};

} // namespace

std::vector<std::string> externalUris(std::span<const std::uint8_t> model) {
  UriCollector collector;
  const std::string_view text = jsonText(model);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &collector)) return {};
  return std::move(collector.uris);
}

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
  return readSceneFile(path, {}, limits);
}

Result<SceneBundle> readSceneFile(const std::filesystem::path& path, std::span<const VolumeOptions> volumes,
                                  const Limits& limits) {
  const bool isPiped = path == "-";
  auto model = isPiped ? readStandardInput(limits.maxSceneBytes) : readFile(path, limits.maxSceneBytes);
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
  const auto add = [&](const std::optional<std::string>& name, const std::string& written, const std::string& pointer,
                       const std::string& who) {
    if (name && bundle.files.contains(*name)) return;
    const auto file = name ? resolve(folder, *name) : std::nullopt;
    if (!file) {
      problems.push_back({ProblemCode::invalidScene, pointer, who + " names a file that isn't inside its folder.",
                          "a relative name without \"..\" or a scheme", written.substr(0, 200)});
      return;
    }
    auto bytes = readFile(*file, room);
    if (!bytes) {
      for (Problem problem : bytes.problems()) {
        problem.pointer = (folder / *name).string();
        problem.detail += " " + who + " names it.";
        problems.push_back(std::move(problem));
      }
      return;
    }
    room -= bytes->size();
    bundle.files[*name] = std::move(*bytes);
  };
  for (const std::string& uri : uris)
    add(percentDecoded(uri), uri, isPiped ? "standard input" : path.string(), "The model");
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    add(volumes[i].file, volumes[i].file, "/volumes/" + std::to_string(i) + "/file", "The volume");
  }
  if (!problems.empty()) return problems;
  return bundle;
}

} // namespace gnomon::cli
