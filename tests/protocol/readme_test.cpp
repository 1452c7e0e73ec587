#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "protocol/fields/field_list.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

const std::string kBegin = "<!-- fields -->\n\n";
const std::string kEnd = "\n<!-- /fields -->";

/// What stands between the markers, from where to how long.
struct Place {
  std::size_t at = 0;
  std::size_t length = 0;
};

std::optional<Place> tableIn(const std::string& page) {
  const std::size_t begin = page.find(kBegin);
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t at = begin + kBegin.size();
  const std::size_t end = page.find(kEnd, at);
  if (end == std::string::npos) return std::nullopt;
  return Place{at, end - at};
}

/// GNOMON_README_UPDATE=1 writes the table first.
TEST(Readme, ItsTableOfFieldsIsThatOfTheRows) {
  const Bytes bytes = testing::readFile(GNOMON_FIELDS);
  std::string page(bytes.begin(), bytes.end());
  auto place = tableIn(page);
  ASSERT_TRUE(place) << "protocol/FIELDS.md has lost its markers: " << kBegin << "..." << kEnd;
  if (std::getenv("GNOMON_README_UPDATE") != nullptr) {
    page.replace(place->at, place->length, fieldTable());
    place = tableIn(page);
    testing::writeFile(GNOMON_FIELDS, std::span(reinterpret_cast<const std::uint8_t*>(page.data()), page.size()));
  }
  EXPECT_EQ(page.substr(place->at, place->length), fieldTable()) << "GNOMON_README_UPDATE=1 writes it anew";
}

} // namespace
} // namespace gnomon
