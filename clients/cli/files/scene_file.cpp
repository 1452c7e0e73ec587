#include "clients/cli/files/scene_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "clients/cli/files/file_io.h"
#include "protocol/base/bytes.h"
#include "protocol/base/scene_bundle.h"
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
  const std::string_view json = text.substr(kHeader + kChunkHeader, length);
  return json.substr(0, json.find_last_not_of('\0') + 1); // some pad with zeros
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

/// Where a path leads, and whether that is inside the folder.
struct Place {
  std::filesystem::path file;
  bool isInside = false;
};

Place placeOf(const std::filesystem::path& folder, const std::filesystem::path& path) {
  std::error_code error;
  const auto root = std::filesystem::canonical(folder, error);
  if (error) return {folder / path, false};
  const auto file = std::filesystem::weakly_canonical(root / path, error);
  if (error) return {root / path, false};
  return {file, isInside(root, file)};
}

class BundleReading {
 public:
  BundleReading(SceneBundle& bundle, std::filesystem::path folder, bool allowOutside, std::size_t room)
      : bundle_(bundle), folder_(std::move(folder)), allowOutside_(allowOutside), room_(room) {}

  /// What is no file, or is not there, is left to the loader.
  void addFileOf(const std::string& uri, const std::string& pointer) {
    const auto named = fileUri(uri);
    if (!named || bundle_.files.contains(named->name)) return;
    const Place place = placeOf(folder_, named->path);
    std::error_code error;
    if (!std::filesystem::exists(place.file, error) || std::filesystem::is_directory(place.file, error)) return;
    if (!place.isInside && !allowOutside_) {
      problems_.push_back({ProblemCode::invalidScene, pointer, "The model names a file outside of its folder.",
                           "with --allow-outside-files any file", uri.substr(0, kMostQuoted)});
      return;
    }
    add(named->name, place.file, folder_ / named->name, "The model");
  }

  void addFileOf(const RequestFile& named) {
    if (named.at) return addFrom(*named.at, named);
    if (bundle_.files.contains(named.name)) return;
    const Place place = isPlainRelative(named.name) ? placeOf(folder_, named.name) : Place{};
    if (!place.isInside) {
      problems_.push_back({ProblemCode::invalidScene, named.pointer,
                           "The " + named.what + " names a file that isn't inside its folder.",
                           "a relative name without \"..\" or a scheme", named.name.substr(0, kMostQuoted)});
      return;
    }
    add(named.name, place.file, folder_ / named.name, "The " + named.what);
  }

  Problems takeProblems() { return std::move(problems_); }

 private:
  static constexpr std::size_t kMostQuoted = 200;

  /// A file from anywhere, which goes under its own name: the model's folder may have another one of that name.
  void addFrom(const std::filesystem::path& file, const RequestFile& named) {
    const auto model = bundle_.files.find(named.name);
    if (model == bundle_.files.end()) return add(named.name, file, file, "The " + named.what);
    std::error_code error;
    if (std::filesystem::equivalent(file, folder_ / named.name, error)) return;
    problems_.push_back({ProblemCode::invalidScene, named.pointer,
                         "The model has another file of the " + named.what + "'s name.", "a name of its own",
                         named.name.substr(0, kMostQuoted)});
  }

  /// `shown`: the file as a problem calls it.
  void add(const std::string& name, const std::filesystem::path& file, const std::filesystem::path& shown,
           const std::string& who) {
    auto bytes = readFile(file, room_);
    if (bytes) {
      room_ -= bytes->size();
      bundle_.files[name] = std::move(*bytes);
      return;
    }
    for (Problem problem : bytes.problems()) {
      problem.pointer = shown.string();
      problem.detail += " " + who + " names it.";
      problems_.push_back(std::move(problem));
    }
  }

  SceneBundle& bundle_;
  std::filesystem::path folder_;
  bool allowOutside_;
  std::size_t room_; ///< bytes
  Problems problems_;
};

} // namespace

Result<SceneBundle> readSceneFile(const std::filesystem::path& path, const SceneFileOptions& options,
                                  std::span<const RequestFile> files, const Limits& limits) {
  const bool isPiped = path == "-";
  auto model = isPiped ? readStandardInput(limits.maxSceneBytes) : readFile(path, limits.maxSceneBytes);
  if (!model) return model.problems();
  SceneBundle bundle;
  bundle.model = std::move(*model);
  bundle.strict = options.strict;

  const auto uris = externalUris(bundle.model);
  if (uris.size() > limits.maxBundleFiles) {
    return Problem{ProblemCode::tooLarge, path.string(), "The model names too many files.",
                   std::to_string(limits.maxBundleFiles), std::to_string(uris.size())};
  }
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  BundleReading reading(bundle, folder, options.allowOutsideFiles, limits.maxSceneBytes - bundle.model.size());
  for (const std::string& uri : uris) reading.addFileOf(uri, isPiped ? "standard input" : path.string());
  for (const RequestFile& file : files) reading.addFileOf(file);
  if (Problems problems = reading.takeProblems(); !problems.empty()) return problems;
  return bundle;
}

} // namespace gnomon::cli
