#include "clients/cli/render/video_run.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/remote/webm_watch.h"
#include "clients/cli/render/sequence_run.h"
#include "protocol/base/bytes.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/video_frames.h"

namespace gnomon::cli {

Result<std::string> videoHere(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                              const TakeBytes& take, ProgressLine& progress) {
  std::optional<VideoFile> video;
  const auto begin = [&](const Image& image) -> Status {
    const VideoTrack track{image.width, image.height, sequence.framesPerSecond, sequence.count - sequence.first};
    auto made = VideoFile::create(track, sequence.videoQuality);
    if (!made) return made.problems();
    video.emplace(*std::move(made));
    return take(video->head());
  };
  const auto add = [&](int, const Frame& frame) -> Status {
    const Image& image = frame.images.front().image;
    auto planes = encodeI420(image);
    if (!planes) return planes.problems();
    if (!video) {
      if (auto begun = begin(image); !begun) return begun;
    }
    const auto piece = video->add({image.width, image.height, *planes});
    if (!piece) return piece.problems();
    return take(*piece);
  };
  auto report = drawSequence(renderer, scene, sequence, videoFrame, add, progress);
  if (!report) return report;
  if (auto taken = take(webmTag(kVideoReportTag, Json::parse(*report).dump())); !taken) return taken.problems();
  return report;
}

Result<std::string> videoThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                               const std::string& requestJson, const Sequence& sequence, const TakeBytes& take,
                               ProgressLine& progress) {
  WebmWatch watch;
  Status taken = Done{};
  ScenePost post{"/sequences", requestJson, "rendering on the server", {"Accept", "video/webm"}};
  post.onReceived = [&](std::string_view bytes) {
    if (!taken) return;
    taken = take(bytes);
    watch.read(bytes);
    showFrame(sequence.first + watch.frames() - 1, sequence.first, sequence.count, progress);
  };
  const auto reply = askAbout(remote, bundle, id, post, progress);
  if (!taken) return taken.problems();
  if (!reply) return reply.problems();
  if (watch.tag() && watch.tag()->name == kVideoReportTag) return watch.tag()->text + "\n";
  if (watch.tag() && watch.tag()->name == kVideoProblemTag) {
    return problemsOf(remote.url, {200, "", watch.tag()->text, 0});
  }
  return Problem{ProblemCode::unavailable, remote.url, "The reply ended before the video did.", "", ""};
}

} // namespace gnomon::cli
