#include <gtest/gtest.h>

#include "clients/cli/remote/http_client.h"

namespace gnomon::cli {
namespace {

const std::string kStream =
    ":\n\nevent: progress\ndata: {\"done\":1}\n\nid: 7\r\nevent:row\r\ndata: a\r\ndata: b\r\n\r\nevent: empty\n\n"
    "data: unnamed\n\nevent: cut\ndata: never ended";

void expectAll(const std::vector<ServerEvent>& events) {
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].name, "progress");
  EXPECT_EQ(events[0].data, "{\"done\":1}");
  EXPECT_EQ(events[1].name, "row");
  EXPECT_EQ(events[1].data, "a\nb");
  EXPECT_EQ(events[2].name, "");
  EXPECT_EQ(events[2].data, "unnamed");
}

TEST(EventReader, ReadsFieldsAndPassesOverTheRest) {
  expectAll(EventReader().read(kStream));
}

TEST(EventReader, ItMakesNoDifferenceWhereTheBytesAreCut) {
  for (const std::size_t step : {1u, 2u, 3u, 7u, 50u}) {
    EventReader reader;
    std::vector<ServerEvent> events;
    for (std::size_t at = 0; at < kStream.size(); at += step) {
      for (ServerEvent& event : reader.read(std::string_view(kStream).substr(at, step))) events.push_back(event);
    }
    expectAll(events);
  }
}

} // namespace
} // namespace gnomon::cli
