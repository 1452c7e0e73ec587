#include "protocol/fields/field_list.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

const FieldEntry& entryAt(const std::vector<FieldEntry>& entries, const std::string& path) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.path == path; });
  if (found == entries.end()) throw std::runtime_error("no field " + path);
  return *found;
}

TEST(FieldList, TellsEachFieldOnce) {
  std::set<std::string> paths;
  for (const FieldEntry& entry : frameFields()) {
    EXPECT_TRUE(paths.insert(entry.path).second) << entry.path;
    EXPECT_FALSE(entry.type.empty()) << entry.path;
    EXPECT_FALSE(entry.says.empty()) << entry.path;
  }
  for (const char* path : {"width", "camera.eye", "camera.orbit.distance", "lights[].sun.azimuthDegrees",
                           "lights[].shadow", "shadow.partition.splits", "output.exrPixelType"}) {
    EXPECT_TRUE(paths.contains(path)) << path;
  }
  EXPECT_FALSE(paths.contains("lights[].shadow.size"));
  EXPECT_FALSE(paths.contains("camera"));
}

TEST(FieldList, TellsTypeBoundsUnitAndDefault) {
  const std::vector<FieldEntry> entries = frameFields();
  const FieldEntry& width = entryAt(entries, "width");
  EXPECT_EQ(width.type, "whole number");
  EXPECT_EQ(width.allowed, "1..16384");
  EXPECT_EQ(width.unit, "pixels");
  EXPECT_EQ(width.preset, "1280");
  EXPECT_EQ(entryAt(entries, "shadow.filter.type").type, "hard | pcf | vsm | evsm | msm | pcss");
  EXPECT_EQ(entryAt(entries, "shadow.filter.size").allowed, "3, 5 or 7");
  EXPECT_EQ(entryAt(entries, "camera.eye").preset, "");
  EXPECT_EQ(entryAt(entries, "camera.node").type, "whole number or string");
}

TEST(FieldList, TheTableHasARowForEachFieldAndFiveCellsInEach) {
  const std::string table = fieldTable();
  std::size_t rows = 0;
  for (std::size_t begin = 0; begin < table.size(); ++rows) {
    const std::size_t end = table.find('\n', begin);
    const std::string row = table.substr(begin, end - begin);
    std::size_t bars = 0;
    for (std::size_t i = 0; i < row.size(); ++i) bars += row[i] == '|' && (i == 0 || row[i - 1] != '\\');
    EXPECT_EQ(bars, 6u) << row;
    begin = end + 1;
  }
  EXPECT_EQ(rows, frameFields().size() + 2);
  EXPECT_THAT(table, testing::HasSubstr(R"(| `atlas.samples` | whole number | 1 or 4 | `1` | Depths in each texel)"));
  EXPECT_THAT(table, testing::HasSubstr(
                         R"(| `shadow.filter.type` | hard \| pcf \| vsm \| evsm \| msm \| pcss |  | `"pcf"` | How)"));
  EXPECT_THAT(table, testing::HasSubstr("hard = one sample, a sharp edge; pcf = ")) << "what each value means";
}

TEST(FieldList, TheHelpNamesEachField) {
  const std::string help = fieldHelp();
  for (const FieldEntry& entry : frameFields()) EXPECT_THAT(help, testing::HasSubstr("  " + entry.path + " "));
}

} // namespace
} // namespace gnomon
