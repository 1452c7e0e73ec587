#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/carry.h"
#include "protocol/spec/enum_rows.h"
#include "server/wire/frame_form.h"
#include "server/wire/sequence_news.h"
#include "server/worker/frame_memory.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// The first view for a video.
Result<std::vector<EncodedPicture>> rawPicture(const Frame& frame) {
  if (frame.images.empty()) return Problem{ProblemCode::internal, "", "The frame has no picture.", "", ""};
  auto planes = encodeI420(frame.images.front().image);
  if (!planes) return planes.problems();
  std::vector<EncodedPicture> pictures;
  pictures.push_back({std::string(spell(frame.images.front().view)), *std::move(planes)});
  return pictures;
}

} // namespace

/// While this encodes, the render thread may draw the next frame, whose order came once this one was drawn.
Answer sequenceFrameOrder(WorkContext& context, const OrderCall& call) {
  const auto spec = decodeFrameSpec(call.request);
  if (!spec) return {.problems = spec.problems()};
  const auto start = Clock::now();
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  const auto& scene = std::get<LoadedScene>(loaded);
  const double loadMs = millisecondsSince(start);
  ByteLease memory(context.frameMemory);
  if (auto taken = takeMemory(memory, context.frameMemory, frameBytes(*spec), "/views", call); !taken) {
    return {.problems = taken.problems()};
  }
  auto drawn = context.renderer.render(scene.scene, *spec, TileUse::kept, call.goOn);
  if (!drawn) return {.problems = call.goOn() ? drawn.problems() : Problems{stoppedProblem("the frame", call)}};
  FrameReport& report = drawn->frame.report;
  call.event(kSequenceNews, textOf(SequenceNews{.drawn = DrawnNews{carriedOf(report), report.warnings}}));
  context.costs.learn(frameCost(report.spec, sceneCounts(scene.summary)), report);

  const auto encoding = Clock::now();
  const bool isRaw = call.order.mediaType == kRawVideo;
  auto pictures =
      isRaw ? rawPicture(drawn->frame) : encodePictures(drawn->frame, drawn->frame.images.size(), call.goOn);
  if (!pictures) return {.problems = call.goOn() ? pictures.problems() : Problems{stoppedProblem("the frame", call)}};
  SequenceNews news;
  Answer answer{.contentType = "application/octet-stream", .stages = std::move(report.stages)};
  std::size_t bytes = 0;
  for (const EncodedPicture& picture : *pictures) bytes += picture.file.size();
  answer.body.reserve(bytes);
  for (EncodedPicture& picture : *pictures) {
    news.pictures.push_back({picture.view, std::string(mediaTypeOf(spec->output.format)), picture.file.size()});
    if (isRaw) {
      const Image& image = drawn->frame.images.front().image;
      news.pictures.back() = {picture.view, std::string(kRawVideo), picture.file.size(), image.width, image.height};
    }
    answer.body += asText(picture.file);
    picture.file = {};
  }
  call.event(kSequenceNews, textOf(news));
  answer.stages.insert(
      answer.stages.begin(),
      {StageTime{"queue", call.order.queuedMilliseconds + drawn->queuedMilliseconds}, StageTime{"load", loadMs}});
  answer.stages.push_back({"encode", millisecondsSince(encoding)});
  return answer;
}

} // namespace gnomon
