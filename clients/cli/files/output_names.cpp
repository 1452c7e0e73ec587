#include "clients/cli/files/output_names.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "clients/cli/files/file_io.h"
#include "protocol/spec/traits.h"

namespace gnomon::cli {

std::string asFileName(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c == '/' || c < 0x20 || c == 0x7f; }, '_');
  return name.empty() || name == "." || name == ".." ? "_" : name;
}

namespace {

std::string listOf(const Placeholders& values) {
  std::string list = "{view}";
  for (const auto& [name, value] : values) list += " {" + name + "}";
  return list;
}

bool isName(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

bool has(const std::string& pattern, const char* placeholder) {
  return pattern.find(placeholder) != std::string::npos;
}

bool hasPlaceholder(const std::string& pattern) {
  return has(pattern, "{scene}") || has(pattern, "{folder}") || has(pattern, "{camera}");
}

/// The placeholders that would make the two names differ; empty where none would.
std::string missingPlaceholders(const std::string& pattern, const BatchItem& a, const BatchItem& b) {
  std::string missing;
  if (a.scene != b.scene && !has(pattern, "{scene}")) missing = "{scene}";
  if (a.scene != b.scene && has(pattern, "{scene}") && !has(pattern, "{folder}")) missing = "{folder}";
  if (a.camera != b.camera && !has(pattern, "{camera}"))
    missing += (missing.empty() ? "" : " and ") + std::string("{camera}");
  return missing.empty() ? "" : "a name with " + missing;
}

/// Marks the items that would write a file which one before them writes.
void markCollisions(std::vector<BatchItem>& items, std::string BatchItem::*file, const std::string& pattern,
                    const char* flag) {
  std::map<std::string, const BatchItem*> owners;
  for (BatchItem& item : items) {
    const std::string& name = item.*file;
    if (name.empty() || item.collision) continue;
    const auto [owner, isNew] = owners.emplace(name, &item);
    if (isNew) continue;
    const std::string what = name == "-" ? "Standard output" : "The file " + name;
    item.collision =
        invalidValue(flag, what + " would be written more than once: by " + owner->second->scene + ", too.",
                     missingPlaceholders(pattern, *owner->second, item));
  }
}

/// The name of the folder that a scene lies in.
std::string folderName(const std::string& path) {
  if (path == "-") return "stdin";
  std::error_code error;
  const auto whole = std::filesystem::absolute(path, error).lexically_normal();
  return error ? "" : whole.parent_path().filename().string();
}

} // namespace

Result<std::string> filledIn(const std::string& pattern, const Placeholders& values) {
  std::string text;
  for (std::size_t at = 0; at < pattern.size();) {
    const std::size_t end = pattern[at] == '{' ? pattern.find('}', at) : std::string::npos;
    const std::string name = end == std::string::npos ? "" : pattern.substr(at + 1, end - at - 1);
    if (!isName(name) || name == "view") {
      text += pattern[at++];
      continue;
    }
    const auto value = values.find(name);
    if (value == values.end()) {
      return invalidValue(pattern, "There is no such placeholder here.", listOf(values), "{" + name + "}");
    }
    text += asFileName(value->second);
    at = end + 1;
  }
  return text;
}

std::string sceneName(const std::string& path) {
  return path == "-" ? "stdin" : std::filesystem::path(path).stem().string();
}

std::string frameNumber(int index) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%05d", index);
  return text.data();
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
    return invalidValue("--output", "Standard output takes one picture.", "1", std::to_string(pictures.size()));
  }
  std::vector<std::string> names;
  for (const Picture& picture : pictures) {
    names.push_back(pictureFile(output, picture.view, pictures.size()));
    if (auto written = writeFile(names.back(), picture.file); !written) return written.problems();
  }
  return names;
}

Result<std::vector<BatchItem>> batchItems(const BatchOrder& order) {
  std::vector<std::optional<std::string>> cameras(order.cameras.begin(), order.cameras.end());
  if (cameras.empty()) cameras.emplace_back();
  std::vector<BatchItem> items;
  for (const std::string& scene : order.scenes) {
    for (const auto& camera : cameras) {
      const Placeholders values{
          {"scene", sceneName(scene)}, {"folder", folderName(scene)}, {"camera", camera.value_or("default")}};
      auto output = filledIn(order.output, values);
      if (!output) return output.problems();
      auto report = filledIn(order.report, values);
      if (!report) return report.problems();
      items.push_back({scene, camera, *std::move(output), *std::move(report), std::nullopt});
    }
  }
  for (const auto& [file, pattern, flag] : {std::tuple(&BatchItem::output, &order.output, "--output"),
                                            std::tuple(&BatchItem::report, &order.report, "--report")}) {
    if (pattern->empty()) continue;
    markCollisions(items, file, *pattern, flag);
    // Of a name that is the same for all, all but the first would fail.
    const auto collided = std::find_if(items.begin(), items.end(), [](const auto& item) { return item.collision; });
    if (collided != items.end() && !hasPlaceholder(*pattern)) return *collided->collision;
  }
  return items;
}

} // namespace gnomon::cli
