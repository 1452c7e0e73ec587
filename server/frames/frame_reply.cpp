#include "server/frames/frame_reply.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/traits.h"
#include "server/http/request.h"
#include "server/system/clock.h"

namespace gnomon {
namespace {

bool needsReference(View view) {
  return traitsOf(view).source == ViewSource::rays;
}

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
  const std::string ending = format == ImageFormat::png ? ".png" : ".exr";
  for (const EncodedPicture& picture : pictures) {
    part(mediaTypeOf(format), (format == ImageFormat::png ? picture.view : "frame") + ending, asText(picture.file));
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

} // namespace

std::size_t frameBytes(const FrameSpec& spec) {
  const std::size_t bytesPerPixel = spec.output.format == ImageFormat::exr ? 16 : 4;
  const auto ofFrame = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::size_t pixels = 0;
  for (const View view : spec.views) {
    const auto side = static_cast<std::size_t>(spec.atlas.size);
    pixels += traitsOf(view).source == ViewSource::atlas ? side * side : ofFrame;
  }
  const bool traced = std::any_of(spec.views.begin(), spec.views.end(), needsReference);
  return pixels * bytesPerPixel + (traced ? ofFrame * kReferenceBytes : 0);
}

std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form) {
  Sha256 hash;
  for (const std::string_view part : {sceneId, std::string_view("\n"), fingerprint, std::string_view("\n"),
                                      mediaTypeOf(form), std::string_view("\n"), mediaTypeOf(form.format)}) {
    hash.add(part);
  }
  hash.add("\n");
  hash.add(jsonText(toJson(spec)));
  const std::string tag = '"' + hash.hex() + '"';
  return form.form == ReplyForm::image ? tag : "W/" + tag;
}

std::string serverTiming(const std::vector<StageTime>& stages) {
  std::string text;
  for (const StageTime& stage : stages) {
    std::array<char, 32> duration;
    const int length = std::snprintf(duration.data(), duration.size(), "%.3f", stage.milliseconds);
    text += (text.empty() ? "" : ", ") + stage.stage + ";dur=";
    text.append(duration.data(), static_cast<std::size_t>(length));
  }
  return text;
}

Result<HttpReply> frameReply(Frame frame, FrameForm form, std::string_view boundary) {
  const auto start = Clock::now();
  const auto pictures = encodePictures(frame, form.form == ReplyForm::image ? 1 : frame.images.size());
  if (!pictures) {
    return pictures.problems();
  }
  if (pictures->empty()) {
    return Problem{ProblemCode::internal, "", "The frame has no picture.", "", ""};
  }
  frame.report.stages.push_back({"encode", millisecondsSince(start)});

  HttpReply reply;
  reply.stages = frame.report.stages;
  reply.headers.emplace_back("Server-Timing", serverTiming(frame.report.stages));
  reply.headers.emplace_back("Timing-Allow-Origin", "*");
  reply.contentType = mediaTypeOf(form);
  switch (form.form) {
    case ReplyForm::image:
      reply.body = asText(pictures->front().file);
      break;
    case ReplyForm::multipart:
      reply.contentType += "; boundary=" + std::string(boundary);
      reply.body = multipartBody(frame, *pictures, form.format, boundary);
      break;
    case ReplyForm::json:
      reply.body = jsonBody(std::move(frame), *pictures, form.format);
      break;
  }
  return reply;
}

} // namespace gnomon
