#include <gtest/gtest.h>

#include "protocol/fields/field_list.h"
#include "tests/support/page_table.h"

namespace gnomon {
namespace {

TEST(Readme, ItsTableOfFieldsIsThatOfTheRows) {
  testing::expectTable(GNOMON_FIELDS, "fields", fieldTable());
}

} // namespace
} // namespace gnomon
