#include "clients/cli/terminal/result_text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "clients/cli/terminal/messages.h"
#include "protocol/base/json.h"
#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

constexpr std::size_t kColumns = 9;
using Line = std::array<std::string, kColumns>;

constexpr std::array kHeads{"", "ms", "x", "wrong %", "false shadow %", "false lit %", "edge px", "flips", ""};

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// Characters rather than bytes.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

double firstTime(const EvaluationReport& report) {
  for (const EvaluationRow& row : report.rows) {
    if (row.milliseconds) return *row.milliseconds;
  }
  return 0;
}

Line lineOf(const EvaluationRow& row, double first, RankedError by) {
  Line line;
  line[0] = printable(shortened(row.name, 48));
  if (!row.milliseconds || !row.metrics) return line;
  const ErrorMetrics& metrics = *row.metrics;
  line[1] = formatted("%.1f", *row.milliseconds);
  line[2] = first > 0 ? formatted("%.2f", *row.milliseconds / first) : "";
  line[3] = by == RankedError::rms ? formatted("%.5f", metrics.rms) : formatted("%.4f", 100 * metrics.misclassified);
  line[4] = formatted("%.4f", 100 * metrics.falseShadow);
  line[5] = formatted("%.4f", 100 * metrics.falseLit);
  line[6] = metrics.edgeDisplacement ? formatted("%.2f", metrics.edgeDisplacement->mean) : "-";
  line[7] = metrics.shimmer ? formatted("%.3f", *metrics.shimmer) : "";
  line[8] = row.pareto.value_or(false) ? "*" : "";
  return line;
}

std::string problemOf(const EvaluationRow& row) {
  if (!row.problems || row.problems->empty()) return "";
  const VariantProblem& problem = row.problems->front();
  return printable((problem.pointer.empty() ? "" : problem.pointer + ": ") + problem.detail);
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string space(width - std::min(width, widthOf(text)), ' ');
  return left ? text + space : space + text;
}

} // namespace

std::string evaluationTable(const EvaluationReport& report) {
  std::vector<Line> lines(1);
  std::copy(kHeads.begin(), kHeads.end(), lines[0].begin());
  if (report.rankedBy == RankedError::rms) lines[0][3] = "rms";
  const double first = firstTime(report);
  for (const EvaluationRow& row : report.rows) lines.push_back(lineOf(row, first, report.rankedBy));
  const bool moved = std::any_of(report.rows.begin(), report.rows.end(),
                                 [](const EvaluationRow& row) { return row.metrics && row.metrics->shimmer; });
  if (!moved) lines[0][7] = "";
  std::array<std::size_t, kColumns> widths{};
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], widthOf(line[i]));
  }
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string line = padded(lines[i][0], widths[0], true);
    const std::string problem = i > 0 ? problemOf(report.rows[i - 1]) : "";
    for (std::size_t column = 1; problem.empty() && column < kColumns; ++column) {
      if (column == 7 && !moved) continue;
      line += "  " + padded(lines[i][column], widths[column], false);
    }
    if (!problem.empty()) line += "  " + problem;
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  const ReferenceReport& reference = report.reference;
  text += formatted("\nHeld against %d traced frame%s (%.0f ms, sorting the scene %.0f ms). ", reference.frames,
                    reference.frames == 1 ? "" : "s", reference.milliseconds, reference.buildMilliseconds);
  return text + "Drawn by " + printable(report.renderer.renderer) +
         ".\n* = no other row is faster with as small an error." +
         (moved ? " Flips: of 1,000 points in one frame of the path.\n" : "\n");
}

std::string errorText(const ErrorMetrics& metrics) {
  std::string text = formatted("wrong %.4f %% (false shadow %.4f %%, false lit %.4f %%)", 100 * metrics.misclassified,
                               100 * metrics.falseShadow, 100 * metrics.falseLit);
  if (metrics.edgeDisplacement) text += formatted(", edges %.2f pixels off", metrics.edgeDisplacement->mean);
  return text;
}

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

/// For cameras and lights: index, node, name, type.
template <class Item>
Branch listed(const char* title, const std::vector<Item>& items) {
  Branch branch{std::string(title) + "  " + std::to_string(items.size()), {}};
  for (const Item& item : items) {
    const std::string index = std::to_string(branch.twigs.size());
    const std::string name = item.name.empty() ? "" : " \"" + printable(item.name) + "\"";
    branch.twigs.push_back({index + ": node " + std::to_string(item.node) + name + ", " + item.type, {}});
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

std::vector<std::string> warningsOf(const std::string& reportJson) {
  const Json report = Json::parse(reportJson, nullptr, false);
  if (!report.is_object()) return {};
  const auto listed = report.find("warnings");
  std::vector<std::string> warnings;
  if (listed == report.end() || !listed->is_array()) return warnings;
  for (const Json& warning : *listed) {
    if (warning.is_string()) warnings.push_back(warning.get<std::string>());
  }
  return warnings;
}

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
