#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"
#include "server/wire/frame_form.h"
#include "server/wire/sequence_news.h"
#include "server/worker/orders.h"

namespace gnomon {
namespace {

/// A frame as it is sent.
struct FrameFile {
  std::string contentType;
  std::string body;
  std::vector<StageTime> stages;       ///< of the frame, with `encode`
  std::vector<std::string> warnings{}; ///< of its report
};

std::string multipartBody(const Frame& frame, const std::vector<EncodedPicture>& pictures, ImageFormat format,
                          std::string_view boundary) {
  std::string body;
  const auto part = [&](std::string_view type, const std::string& name, std::string_view content) {
    body.append("--").append(boundary).append("\r\nContent-Type: ").append(type);
    body.append("\r\nContent-Disposition: attachment; filename=\"").append(name);
    body.append("\"\r\nContent-Length: ").append(std::to_string(content.size())).append("\r\n\r\n");
    body.append(content).append("\r\n");
  };
  part("application/json", "report.json", jsonText(toJson(frame.report)));
  const FormatTraits& traits = traitsOf(format);
  for (const EncodedPicture& picture : pictures) {
    part(traits.mediaType, std::string(traits.allViews ? "frame" : picture.view).append(traits.suffix),
         asText(picture.file));
  }
  return body.append("--").append(boundary).append("--\r\n");
}

std::string jsonBody(Frame frame, const std::vector<EncodedPicture>& pictures, ImageFormat format) {
  FrameReply reply;
  reply.report = std::move(frame.report);
  for (const EncodedPicture& picture : pictures) {
    reply.images.push_back({picture.view, std::string(mediaTypeOf(format)), base64Text(picture.file)});
  }
  return jsonText(toJson(reply));
}

/// Encodes the frame and adds the stage `encode` to its report. `format`: of its pictures. `mediaType`: theirs, for one
/// file of the first view or, as the format has it, of all; multipart/mixed, whose parts `boundary` separates, which
/// must not occur in a picture by chance; or application/json. `goOn`: as encodePictures takes it.
Result<FrameFile> frameFile(Frame frame, ImageFormat format, std::string_view mediaType, std::string_view boundary,
                            const GoOn& goOn) {
  const auto start = std::chrono::steady_clock::now();
  const bool isPicture = mediaType == mediaTypeOf(format);
  const auto pictures = encodePictures(frame, isPicture ? 1 : frame.images.size(), goOn);
  if (!pictures) return pictures.problems();
  if (pictures->empty()) return Problem{ProblemCode::internal, "", "The frame has no picture.", "", ""};
  frame.report.stages.push_back({"encode", millisecondsSince(start)});
  FrameFile file{std::string(mediaType), {}, frame.report.stages, frame.report.warnings};
  frame.images.clear(); // before the files are copied
  if (isPicture) {
    file.body = asText(pictures->front().file);
  } else if (mediaType == mediaTypeOf({ReplyForm::multipart, format})) {
    file.contentType += "; boundary=" + std::string(boundary);
    file.body = multipartBody(frame, *pictures, format, boundary);
  } else {
    file.body = jsonBody(std::move(frame), *pictures, format);
  }
  return file;
}

/// Whether an order wants what a sensor sees instead of a frame's picture.
bool wantsSensor(const Order& order) {
  return order.depthRange.has_value() || order.labels;
}

/// That file: depths, or the colors of labels. REQUIRES: the frame has floats of view depth or materials alone.
Result<FrameFile> sensorFile(const ScenePtr& scene, Frame frame, const Order& order, const GoOn& goOn) {
  const auto start = Clock::now();
  auto file = [&]() -> Result<Bytes> {
    if (order.labels) return labelPng(*scene, frame, goOn);
    if (order.mediaType == "image/png") return depthPng(frame, *order.depthRange, goOn);
    return depthTiff(frame, *order.depthRange, goOn);
  }();
  if (!file) return std::move(file).problems();
  frame.report.stages.push_back({"encode", millisecondsSince(start)});
  return FrameFile{order.mediaType, std::string(asText(*file)), std::move(frame.report.stages),
                   std::move(frame.report.warnings)};
}

/// What the order wants of the frame.
Result<FrameFile> fileOf(Frame frame, const ScenePtr& scene, const FrameSpec& spec, const OrderCall& call) {
  const Order& order = call.order;
  if (wantsSensor(order)) return sensorFile(scene, std::move(frame), order, call.goOn);
  return frameFile(std::move(frame), spec.output.format, order.mediaType, order.boundary, call.goOn);
}

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

Answer frameOrder(WorkContext& context, const OrderCall& call) {
  auto decoded = decodeFrameSpec(call.request);
  if (!decoded) return {.problems = decoded.problems()};
  FrameSpec spec = *std::move(decoded);

  const auto start = Clock::now();
  auto loaded = sceneOf(context, call);
  if (auto* answer = std::get_if<Answer>(&loaded)) return std::move(*answer);
  const auto& scene = std::get<LoadedScene>(loaded);
  const double loadMs = millisecondsSince(start);

  std::optional<QualityReport> quality;
  if (spec.quality) {
    auto settled = settleQuality(context, scene, spec, call);
    if (!settled) return {.problems = settled.problems()};
    quality = *std::move(settled);
    spec = withChoice(spec, *quality);
  }
  const std::size_t bytes = bytesOf(context, scene, spec, call.order.mediaType == kJson);
  ByteLease memory(context.frameMemory);
  if (auto taken = takeMemory(memory, context.frameMemory, bytes, "/views", call); !taken) {
    return {.problems = taken.problems()};
  }
  std::optional<Result<FrameFile>> file;
  const auto drawn = context.renderer.renderAndFinish(scene.scene, spec, call.goOn, [&](DrawnFrame& frame) {
    FrameReport& report = frame.frame.report;
    report.stages.insert(
        report.stages.begin(),
        {StageTime{"queue", call.order.queuedMilliseconds + frame.queuedMilliseconds}, StageTime{"load", loadMs}});
    report.quality = quality;
    context.costs.learn(frameCost(report.spec, sceneCounts(scene.summary)), report);
    file = fileOf(std::move(frame.frame), scene.scene, spec, call);
  });
  if (!drawn) return {.problems = call.goOn() ? drawn.problems() : Problems{stoppedProblem("the frame", call)}};
  if (!*file) return {.problems = call.goOn() ? file->problems() : Problems{stoppedProblem("the frame", call)}};
  FrameFile& made = **file;
  return {.contentType = std::move(made.contentType),
          .body = std::move(made.body),
          .stages = std::move(made.stages),
          .warnings = std::move(made.warnings)};
}

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
  if (auto taken = takeMemory(memory, context.frameMemory, bytesOf(context, scene, *spec), "/views", call); !taken) {
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
