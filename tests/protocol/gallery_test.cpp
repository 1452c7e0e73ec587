// The requests of tests/gallery are ones that a server takes.
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "tests/protocol/found_problems.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

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

} // namespace
} // namespace gnomon
