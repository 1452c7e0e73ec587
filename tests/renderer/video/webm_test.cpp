#include <gtest/gtest.h>

#include "renderer/video/video_file.h"
#include "tests/renderer/video/parsed_webm.h"

namespace gnomon {
namespace {

TEST(Webm, TheHeadTellsWhatTheTrackIs) {
  const VideoTrack track{.width = 641, .height = 359, .framesPerSecond = 30, .frames = 90};
  const ParsedWebm parsed = parsedWebm(webmHead(track));
  EXPECT_EQ(parsed.ebml.doc_type.value(), "webm");
  EXPECT_EQ(parsed.info.timecode_scale.value(), 1'000'000u);
  EXPECT_DOUBLE_EQ(parsed.info.duration.value(), 3'000);
  ASSERT_EQ(parsed.tracks.size(), 1u);
  const webm::TrackEntry& entry = parsed.tracks.front();
  EXPECT_EQ(entry.track_type.value(), webm::TrackType::kVideo);
  EXPECT_EQ(entry.codec_id.value(), "V_VP9");
  EXPECT_EQ(entry.default_duration.value(), 33'333'333u);
  const webm::Video& video = entry.video.value();
  EXPECT_EQ(video.pixel_width.value(), 641u);
  EXPECT_EQ(video.pixel_height.value(), 359u);
  const webm::Colour& colour = video.colour.value();
  EXPECT_EQ(colour.matrix_coefficients.value(), webm::MatrixCoefficients::kBt709);
  EXPECT_EQ(colour.range.value(), webm::Range::kBroadcast);
  EXPECT_EQ(colour.transfer_characteristics.value(), webm::TransferCharacteristics::kIec6196621);
  EXPECT_EQ(colour.primaries.value(), webm::Primaries::kBt709);
  EXPECT_EQ(colour.chroma_subsampling_x.value(), 1u);
  EXPECT_EQ(colour.chroma_subsampling_y.value(), 1u);
}

RC_GTEST_PROP(Webm, FramesAreReadAtTheirTimes, ()) {
  const VideoTrack track{.width = 16,
                         .height = 16,
                         .framesPerSecond = *rc::gen::inRange(1000, 240'001) / 1000.0,
                         .frames = *rc::gen::inRange(1, 40)};
  std::string file = webmHead(track);
  std::vector<std::string> contents;
  const int start = *rc::gen::element(0, 9'000);
  for (int i = 0; i < track.frames; ++i) {
    // Sizes around those at which an element's size takes a byte more.
    const auto size =
        *rc::gen::element<std::size_t>(1, 100, 121, 122, 123, 124, 127, 128, 16'370, 16'379, 16'384, 70'000);
    contents.push_back(std::string(size, static_cast<char>('a' + i % 20)));
    file += webmFrame(track, start + i, contents.back(), i % 7 == 0);
  }
  file += webmTag("GNOMON_REPORT", "{}");
  const ParsedWebm parsed = parsedWebm(file);
  RC_ASSERT(parsed.isWhole);
  RC_ASSERT(parsed.frames.size() == contents.size());
  for (int i = 0; i < track.frames; ++i) {
    const ParsedFrame& frame = parsed.frames[static_cast<std::size_t>(i)];
    RC_ASSERT(std::abs(static_cast<double>(frame.milliseconds) - (start + i) * 1000 / track.framesPerSecond) <= 0.5);
    RC_ASSERT(frame.isKey == (i % 7 == 0));
    RC_ASSERT(asText(frame.bytes) == contents[static_cast<std::size_t>(i)]);
  }
}

TEST(Webm, ATagIsReadWithItsName) {
  const std::string text(100'000, 'x');
  const ParsedWebm parsed = parsedWebm(webmHead({.width = 1, .height = 1, .frames = 1}) + webmTag("SOME_NAME", text));
  ASSERT_EQ(parsed.tags.size(), 1u);
  EXPECT_EQ(parsed.tags[0].tags.at(0).value().name.value(), "SOME_NAME");
  EXPECT_EQ(parsed.tags[0].tags.at(0).value().string.value(), text);
}

} // namespace
} // namespace gnomon
