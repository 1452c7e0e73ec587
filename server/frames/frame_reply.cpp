#include "server/frames/frame_reply.h"

#include <array>
#include <cstdio>

#include "server/http/ascii.h"
#include "server/http/http_request.h"
#include "server/http/json_reply.h"
#include "server/http/socket_io.h"

namespace gnomon {
namespace {

struct Picture {
  std::string view; ///< of an EXR, which holds every view, the first
  Bytes bytes;
};

/// A PNG for each of the first `count` views, or one EXR of them all.
Result<std::vector<Picture>> encode(const Frame& frame, ImageFormat format, std::size_t count) {
  const Json names = toJson(frame.report.spec)["views"];
  const auto nameOf = [&](std::size_t index) { return index < names.size() ? names[index].get<std::string>() : ""; };
  std::vector<Picture> pictures;
  if (format == ImageFormat::exr) {
    auto bytes = encodeExr(frame);
    if (!bytes) {
      return std::move(bytes).problems();
    }
    pictures.push_back({nameOf(0), *std::move(bytes)});
    return pictures;
  }
  for (std::size_t i = 0; i < std::min(count, frame.images.size()); ++i) {
    auto bytes = encodePng(frame, i);
    if (!bytes) {
      return std::move(bytes).problems();
    }
    pictures.push_back({nameOf(i), *std::move(bytes)});
  }
  return pictures;
}

std::string mixed(const Frame& frame, const std::vector<Picture>& pictures, ImageFormat format,
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
  for (const Picture& picture : pictures) {
    part(mediaTypeOf(format), (format == ImageFormat::png ? picture.view : "frame") + ending, textOf(picture.bytes));
  }
  return body.append("--").append(boundary).append("--\r\n");
}

std::string json(Frame frame, const std::vector<Picture>& pictures, ImageFormat format) {
  FrameReply reply;
  reply.report = std::move(frame.report);
  for (const Picture& picture : pictures) {
    reply.images.push_back({picture.view, std::string(mediaTypeOf(format)), base64Text(textOf(picture.bytes))});
  }
  return jsonText(toJson(reply));
}

} // namespace

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
  const auto pictures = encode(frame, form.format, form.form == ReplyForm::image ? 1 : frame.images.size());
  if (!pictures) {
    return pictures.problems();
  }
  if (pictures->empty()) {
    return Problem{ProblemCode::internal, "", "The frame holds no picture.", "", ""};
  }
  const std::chrono::duration<double, std::milli> took = Clock::now() - start;
  frame.report.stages.push_back({"encode", took.count()});

  HttpReply reply;
  reply.stages = frame.report.stages;
  reply.headers.emplace_back("Server-Timing", serverTiming(frame.report.stages));
  reply.headers.emplace_back("Timing-Allow-Origin", "*");
  reply.contentType = mediaTypeOf(form);
  switch (form.form) {
    case ReplyForm::image:
      reply.body = textOf(pictures->front().bytes);
      break;
    case ReplyForm::multipart:
      reply.contentType += "; boundary=" + std::string(boundary);
      reply.body = mixed(frame, *pictures, form.format, boundary);
      break;
    case ReplyForm::json:
      reply.body = json(std::move(frame), *pictures, form.format);
      break;
  }
  return reply;
}

} // namespace gnomon
