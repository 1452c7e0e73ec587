#include "clients/cli/remote/webm_watch.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "renderer/video/webm.h"

namespace gnomon::cli {
namespace {

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
