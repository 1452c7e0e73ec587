#include "clients/cli/terminal/evaluation_table.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "clients/cli/terminal/messages.h"
#include "protocol/base/text.h"

namespace gnomon::cli {
namespace {

constexpr std::size_t kColumns = 9;
using Line = std::array<std::string, kColumns>;

constexpr std::array kHeads{"", "ms", "x", "wrong %", "false shadow %", "false lit %", "edge px", "flips", ""};

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 64> text;
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

Line lineOf(const EvaluationRow& row, double first) {
  Line line;
  line[0] = printable(shortened(row.name, 48));
  if (!row.milliseconds || !row.metrics) return line;
  const ErrorMetrics& metrics = *row.metrics;
  line[1] = formatted("%.1f", *row.milliseconds);
  line[2] = first > 0 ? formatted("%.2f", *row.milliseconds / first) : "";
  line[3] = formatted("%.4f", 100 * metrics.misclassified);
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
  const double first = firstTime(report);
  for (const EvaluationRow& row : report.rows) lines.push_back(lineOf(row, first));
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
  return text + "Drawn by " + printable(report.renderer.renderer) + ".\n* = nothing here is faster and no more wrong." +
         (moved ? " Flips: of 1,000 points in one frame of the path.\n" : "\n");
}

} // namespace gnomon::cli
