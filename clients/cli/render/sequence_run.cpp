#include "clients/cli/render/sequence_run.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "clients/cli/remote/http_client.h"
#include "clients/cli/remote/remote_scene.h"
#include "clients/cli/remote/webm_watch.h"
#include "protocol/base/bytes.h"
#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"

namespace gnomon::cli {
namespace {

/// The same problems, pointing to the frame's place in the request.
Problems placed(Problems problems, const std::string& place) {
  for (Problem& problem : problems) problem.pointer.insert(0, place);
  return problems;
}

} // namespace

void showFrame(int index, int first, int of, ProgressLine& progress) {
  progress.share(static_cast<double>(index + 1 - first) / std::max(of - first, 1));
}

Result<std::string> drawSequence(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                                 FrameSpec (*change)(FrameSpec), const TakeDrawn& take, ProgressLine& progress) {
  progress.stage("rendering");
  const auto begun = std::chrono::steady_clock::now();
  SequenceReport report;
  report.renderer = renderer.info();
  report.carried = sequence.carried;
  report.framesPerSecond = sequence.framesPerSecond;
  for (int index = sequence.first; index < sequence.count; ++index) {
    const auto start = std::chrono::steady_clock::now();
    auto frame = renderer.render(scene, change(frameSpec(sequence, index, report.carried)));
    if (!frame) return placed(frame.problems(), framePlace(sequence, index));
    report.carried = carriedAfter(report.carried, carriedOf(frame->report));
    if (auto taken = take(index, *frame); !taken) return taken.problems();
    report.frames.push_back({index, millisecondsSince(start), std::move(frame->report.stages)});
    for (std::string& warning : frame->report.warnings) {
      const bool isNew = std::find(report.warnings.begin(), report.warnings.end(), warning) == report.warnings.end();
      if (isNew) report.warnings.push_back(std::move(warning));
    }
    showFrame(index, sequence.first, sequence.count, progress);
  }
  report.milliseconds = millisecondsSince(begun);
  return toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::string> sequenceHere(Renderer& renderer, const ScenePtr& scene, const Sequence& sequence,
                                 const TakeFrame& take, ProgressLine& progress) {
  const auto encode = [&](int index, const Frame& frame) -> Status {
    auto encoded = encodePictures(frame, frame.images.size());
    if (!encoded) return placed(encoded.problems(), framePlace(sequence, index));
    std::vector<Picture> pictures;
    for (EncodedPicture& picture : *encoded) pictures.push_back({std::move(picture.view), std::move(picture.file)});
    return take(index, pictures);
  };
  const auto asItIs = [](FrameSpec spec) { return spec; };
  return drawSequence(renderer, scene, sequence, asItIs, encode, progress);
}

namespace {

/// What an event `frame` brings; nothing where it is none.
struct SentFrame {
  int index = 0;
  int of = 0;
  std::vector<Picture> pictures;
};

std::optional<SentFrame> frameOf(const std::string& data) {
  const Json json = Json::parse(data, nullptr, false);
  if (!json.is_object() || !json.contains("index") || !json.contains("of") || !json.contains("images")) {
    return std::nullopt;
  }
  if (!json["index"].is_number_integer() || !json["of"].is_number_integer()) return std::nullopt;
  SentFrame frame{json["index"].get<int>(), json["of"].get<int>(), {}};
  for (const Json& image : json["images"]) {
    if (!image.is_object()) return std::nullopt;
    auto file = base64Bytes(textAt(image, "data"));
    if (!file) return std::nullopt;
    frame.pictures.push_back({textAt(image, "view"), *std::move(file)});
  }
  return frame;
}

} // namespace

Result<std::string> sequenceThere(const Remote& remote, const SceneBundle& bundle, std::string& id,
                                  const std::string& requestJson, const TakeFrame& take, ProgressLine& progress) {
  Status taken = Done{};
  std::optional<int> first;
  const auto onEvent = [&](const ServerEvent& event) {
    if (event.name != "frame" || !taken) return;
    const auto frame = frameOf(event.data);
    if (!frame) {
      taken = Problem{ProblemCode::internal, remote.url, "The reply is not a sequence."};
      return;
    }
    if (!first) first = frame->index;
    taken = take(frame->index, frame->pictures);
    showFrame(frame->index, *first, frame->of, progress);
  };
  const auto report = askWithEvents(remote, bundle, id, {"/sequences", requestJson, "rendering on the server"},
                                    "sequence", onEvent, progress);
  if (!taken) return taken.problems();
  if (!report) return report.problems();
  return *report + "\n";
}

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
  return Problem{ProblemCode::unavailable, remote.url, "The reply ended before the video did."};
}

} // namespace gnomon::cli
