#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/webm_watch.h"
#include "renderer/video/video_file.h"

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

/// `text` in pieces of any size.
void readInPieces(WebmWatch& watch, std::string_view text) {
  while (!text.empty()) {
    const auto size = std::min<std::size_t>(text.size(), *rc::gen::element<std::size_t>(1, 2, 7, 50, 1000, 100'000));
    watch.read(text.substr(0, size));
    text.remove_prefix(size);
  }
}

RC_GTEST_PROP(WebmWatch, CountsFramesAndFindsTheTagHoweverTheBytesAreCut, ()) {
  const VideoTrack track{.width = 64, .height = 48, .framesPerSecond = 30, .frames = 5};
  const int frames = *rc::gen::inRange(0, 5);
  std::string file = webmHead(track);
  for (int i = 0; i < frames; ++i) {
    file += webmFrame(track, i, std::string(*rc::gen::element<std::size_t>(1, 126, 127, 300, 20'000), 'x'), i == 0);
  }
  const std::string text(*rc::gen::element<std::size_t>(2, 127, 128, 40'000), 'j');
  WebmWatch watch;
  readInPieces(watch, file);
  RC_ASSERT(watch.frames() == frames);
  RC_ASSERT(!watch.tag());
  readInPieces(watch, webmTag("GNOMON_REPORT", text));
  RC_ASSERT(watch.tag().has_value());
  RC_ASSERT(watch.tag()->name == "GNOMON_REPORT");
  RC_ASSERT(watch.tag()->text == text);
}

RC_GTEST_PROP(WebmWatch, OutlivesAnyBytes, ()) {
  WebmWatch watch;
  readInPieces(watch, *rc::gen::arbitrary<std::string>());
  readInPieces(watch, std::string("\x12\x54\xc3\x67") + *rc::gen::arbitrary<std::string>());
}

TEST(WebmWatch, WaitsForNoTagsWithoutEnd) {
  WebmWatch watch;
  watch.read("\x12\x54\xc3\x67\x01\xff\xff\xff\xff\xff\xff\xff");
  for (int i = 0; i < 1000; ++i) watch.read(std::string(1000, 'x'));
  EXPECT_FALSE(watch.tag());
}

} // namespace
} // namespace gnomon::cli
