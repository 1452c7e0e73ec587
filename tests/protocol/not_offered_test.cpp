// What users of the described systems may look for and not find; renderer/LIMITATIONS.md says why it is not there.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/fields/field_list.h"
#include "protocol/json/json_codec.h"
#include "tests/protocol/found_problems.h"
#include "tests/support/files.h"
#include "tests/support/page_table.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(NotOffered, X30_X33_M12_ItsNamesAreRefusedAndTheProblemListsWhatThereIs) {
  const auto spec = decodeFrameSpec(R"({
      "lights": [{"type": "point", "position": [0, 2, 0], "shadowType": "dualParaboloid"}],
      "shadow": {"computeTransmittance": true, "filter": {"type": "paraboloid"}},
      "atlas": {"format": "rgba8"}})");
  EXPECT_THAT(pointersOf(spec), ElementsAre("/lights/0/shadowType", "/shadow/computeTransmittance",
                                            "/shadow/filter/type", "/atlas/format"));
  ASSERT_FALSE(spec);
  EXPECT_THAT(spec.problems()[0].limit, HasSubstr("shadow"));
  EXPECT_THAT(spec.problems()[1].limit, HasSubstr("strength"));
  EXPECT_THAT(spec.problems()[2].limit, HasSubstr("pcf"));
  EXPECT_THAT(spec.problems()[3].limit, HasSubstr("baseSize"));
}

TEST(Gallery, EveryRequestIsAValidFrameSpec) {
  const Bytes bytes = testing::readFile(GNOMON_GALLERY "/pictures.json");
  const Json entries = Json::parse(bytes.begin(), bytes.end());
  ASSERT_FALSE(entries.empty());
  for (const Json& entry : entries) {
    const Json variants = entry.value("variants", Json::array({Json::object()}));
    for (const Json& patch : variants) {
      Json request = entry.at("request");
      request.merge_patch(patch);
      EXPECT_THAT(pointersOf(decodeFrameSpec(request.dump())), ::testing::IsEmpty())
          << entry.at("name") << ' ' << patch;
    }
  }
}

TEST(Readme, ItsTableOfFieldsIsThatOfTheRows) {
  testing::expectTable(GNOMON_FIELDS, "fields", fieldTable());
}

} // namespace
} // namespace gnomon
