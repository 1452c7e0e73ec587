#include "clients/cli/terminal/summary_text.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "clients/cli/terminal/messages.h"

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

/// "1 mesh", "2 meshes".
std::string counted(std::uint64_t number, const char* one, const char* many) {
  return grouped(number) + " " + (number == 1 ? one : many);
}

std::string readableBytes(std::uint64_t bytes) {
  if (bytes < 1024) return counted(bytes, "byte", "bytes");
  const char* unit = bytes < (1u << 20) ? "KiB" : "MiB";
  const double number = static_cast<double>(bytes) / (bytes < (1u << 20) ? 1024.0 : 1024.0 * 1024.0);
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %s", number, unit);
  return text;
}

std::string threeNumbers(double x, double y, double z, const char* between) {
  char text[96];
  std::snprintf(text, sizeof text, "%.4g%s%.4g%s%.4g", x, between, y, between, z);
  return text;
}

std::string point(const std::array<double, 3>& p) {
  return threeNumbers(p[0], p[1], p[2], ", ");
}

Branch memoryBranch(const SceneSummary& s) {
  Branch branch{"memory  " + readableBytes(s.memoryBytes), {}};
  const std::pair<const char*, std::uint64_t> parts[] = {
      {"vertices", s.memory.vertices},       {"indices", s.memory.indices},       {"images", s.memory.images},
      {"deformation", s.memory.deformation}, {"animations", s.memory.animations}, {"structure", s.memory.structure}};
  for (const auto& [name, bytes] : parts) {
    if (bytes > 0) branch.twigs.push_back({std::string(name) + "  " + readableBytes(bytes), {}});
  }
  return branch;
}

Branch boundsBranch(const SceneSummary& s) {
  const auto& low = s.boundsMin;
  const auto& high = s.boundsMax;
  return {"bounds  " + threeNumbers(high[0] - low[0], high[1] - low[1], high[2] - low[2], " x ") + " m",
          {{"from " + point(low), {}}, {"to   " + point(high), {}}}};
}

Branch geometryBranch(const SceneSummary& s) {
  return {"geometry  " + counted(s.triangles, "triangle", "triangles"),
          {{counted(s.nodes, "node", "nodes"), {}},
           {counted(s.meshes, "mesh", "meshes") + ", placed as " +
                counted(s.instances, "instance of a primitive", "instances of primitives"),
            {}},
           {counted(s.vertices, "vertex", "vertices"), {}}}};
}

Branch appearanceBranch(const SceneSummary& s) {
  return {"appearance  " + counted(s.materials, "material", "materials"),
          {{counted(s.textures, "texture", "textures") + " of " + counted(s.images, "image", "images"), {}}}};
}

Branch animationsBranch(const SceneSummary& s) {
  Branch branch{counted(s.animations.size(), "animation", "animations"), {}};
  for (const AnimationSummary& animation : s.animations) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.6g s", animation.durationSeconds);
    const std::string name = animation.name.empty() ? "" : "\"" + printable(animation.name) + "\", ";
    branch.twigs.push_back({name + seconds, {}});
  }
  return branch;
}

/// What moves; only what there is.
Branch motionBranch(const SceneSummary& s) {
  Branch branch{"motion", {}};
  if (s.skins > 0) {
    branch.twigs.push_back({counted(s.skins, "skin", "skins") + " of " + counted(s.joints, "joint", "joints"), {}});
  }
  if (s.morphTargets > 0) branch.twigs.push_back({counted(s.morphTargets, "morph target", "morph targets"), {}});
  if (!s.animations.empty()) branch.twigs.push_back(animationsBranch(s));
  return branch;
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

Branch extensionsBranch(const SceneSummary& s) {
  Branch branch{"extensions  " + std::to_string(s.extensionsUsed.size()), {}};
  for (const std::string& name : s.extensionsUsed) {
    const bool ignored = std::count(s.extensionsIgnored.begin(), s.extensionsIgnored.end(), name) > 0;
    branch.twigs.push_back({printable(name) + (ignored ? "  (ignored)" : ""), {}});
  }
  return branch;
}

Branch warningsBranch(const SceneSummary& s) {
  Branch branch{"drawn differently  " + std::to_string(s.warnings.size()), {}};
  for (const std::string& warning : s.warnings) branch.twigs.push_back({printable(warning), {}});
  return branch;
}

} // namespace

std::string summaryText(const std::string& title, const SceneSummary& s) {
  std::vector<Branch> branches{{"file  " + readableBytes(s.bytes), {}}, memoryBranch(s), boundsBranch(s)};
  if (s.scenes > 1) {
    branches.push_back(
        {"scenes  " + std::to_string(s.scenes) + ", shown is the default: scene " + std::to_string(s.defaultScene),
         {}});
  }
  branches.push_back(geometryBranch(s));
  branches.push_back(appearanceBranch(s));
  // What a scene does not have takes no line.
  Branch motion = motionBranch(s);
  if (!motion.twigs.empty()) branches.push_back(std::move(motion));
  if (!s.cameras.empty()) branches.push_back(listed("cameras", s.cameras));
  if (!s.lights.empty()) branches.push_back(listed("lights", s.lights));
  if (!s.extensionsUsed.empty()) branches.push_back(extensionsBranch(s));
  if (!s.warnings.empty()) branches.push_back(warningsBranch(s));
  return printable(title) + "\n" + drawn(branches, "");
}

} // namespace gnomon::cli
