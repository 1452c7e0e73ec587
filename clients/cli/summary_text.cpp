#include "clients/cli/summary_text.h"

#include <cstdio>
#include <vector>

#include "clients/cli/terminal_text.h"

namespace gnomon::cli {
namespace {

struct Branch {
  std::string text;
  std::vector<Branch> twigs;
};

std::string drawn(const std::vector<Branch>& branches, const std::string& indent) {
  std::string text;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const bool last = i + 1 == branches.size();
    text += indent + (last ? "└─ " : "├─ ") + branches[i].text + "\n";
    text += drawn(branches[i].twigs, indent + (last ? "   " : "│  "));
  }
  return text;
}

/// 1234567 -> "1 234 567".
std::string grouped(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

std::string readableBytes(std::uint64_t bytes) {
  if (bytes < 1024) return std::to_string(bytes) + " bytes";
  const char* unit = bytes < (1u << 20) ? "KiB" : "MiB";
  const double number = static_cast<double>(bytes) / (bytes < (1u << 20) ? 1024.0 : 1024.0 * 1024.0);
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %s", number, unit);
  return text;
}

std::string metres(const std::array<double, 3>& point) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6g %.6g %.6g", point[0], point[1], point[2]);
  return text;
}

/// For cameras and lights: node, name, type.
template <class Item>
Branch listed(const char* title, const std::vector<Item>& items) {
  Branch branch{std::string(title) + "  " + std::to_string(items.size()), {}};
  for (const Item& item : items) {
    const std::string name = item.name.empty() ? "" : " \"" + printable(item.name) + "\"";
    branch.twigs.push_back({"node " + std::to_string(item.node) + name + ", " + item.type, {}});
  }
  return branch;
}

Branch listedText(const char* title, const std::vector<std::string>& items) {
  Branch branch{std::string(title) + "  " + std::to_string(items.size()), {}};
  for (const std::string& item : items) branch.twigs.push_back({printable(item), {}});
  return branch;
}

} // namespace

std::string summaryText(const std::string& title, const SceneSummary& s) {
  std::vector<Branch> branches{
      {"size  " + readableBytes(s.bytes) + ", " + readableBytes(s.memoryBytes) + " loaded", {}},
      {"scenes  " + std::to_string(s.scenes) + " (default " + std::to_string(s.defaultScene) + ")", {}},
      {"geometry",
       {{grouped(s.triangles) + " triangles, " + grouped(s.vertices) + " vertices", {}},
        {grouped(s.nodes) + " nodes, " + grouped(s.meshes) + " meshes", {}},
        {grouped(s.materials) + " materials, " + grouped(s.images) + " images", {}},
        {grouped(s.animations) + " animations", {}}}},
      {"bounds, metres", {{"from " + metres(s.boundsMin), {}}, {"to   " + metres(s.boundsMax), {}}}},
      listed("cameras", s.cameras),
      listed("lights", s.lights)};
  if (!s.extensionsUsed.empty()) branches.push_back(listedText("extensions", s.extensionsUsed));
  if (!s.warnings.empty()) branches.push_back(listedText("warnings", s.warnings));
  return printable(title) + "\n" + drawn(branches, "");
}

} // namespace gnomon::cli
