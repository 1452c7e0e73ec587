// What users of the described systems may look for and not find; renderer/LIMITATIONS.md says why it is not there.
#include "protocol/json/json_codec.h"
#include "tests/protocol/found_problems.h"

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

} // namespace
} // namespace gnomon
