#include "tests/hard_cases/hard_table.h"

#include <array>
#include <cstdio>

namespace gnomon::testing {
namespace {

struct Column {
  const char* title;
  const char* metric;
  double scale;
  int digits;
};
constexpr std::array<Column, 6> kColumns{{{"misclassified %", "misclassified", 100, 4},
                                          {"interior %", "interior", 100, 4},
                                          {"acne %", "acne", 100, 4},
                                          {"leak %", "leak", 100, 4},
                                          {"edge px", "edgeDisplacement", 1, 3},
                                          {"flips", "shimmer", 1, 3}}};

std::string padded(const std::string& text, int width) {
  std::array<char, 128> line{};
  std::snprintf(line.data(), line.size(), "%*s", width, text.c_str());
  return line.data();
}

std::string number(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

double hardMapOf(const std::vector<HardRow>& rows, const std::string& name) {
  for (const HardRow& row : rows) {
    if (row.name == name && row.way == "hard") return row.milliseconds;
  }
  return 0;
}

} // namespace

std::string tableOf(const std::vector<HardRow>& rows) {
  std::string table = padded("case", -44) + padded("shadows", -14);
  for (const Column& column : kColumns) table += padded(column.title, 17);
  table += padded("x hard map", 12) + "\n";
  for (const HardRow& row : rows) {
    table += padded(row.name, -44) + padded(row.way, -14);
    if (row.metrics.is_null()) {
      table += "  refused, as it should be\n";
      continue;
    }
    for (const Column& column : kColumns) {
      const bool known = row.metrics.contains(column.metric);
      table += padded(known ? number(row.metrics[column.metric].get<double>() * column.scale, column.digits) : "-", 17);
    }
    const double hard = hardMapOf(rows, row.name);
    table += padded(hard > 0 ? number(row.milliseconds / hard, 2) : "-", 12) + "\n";
  }
  return table;
}

Json numbersOf(const std::vector<HardRow>& rows) {
  Json numbers = Json::object();
  for (const HardRow& row : rows) numbers[row.name][row.way] = row.metrics;
  return numbers;
}

} // namespace gnomon::testing
