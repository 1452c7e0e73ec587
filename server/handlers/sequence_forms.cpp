#include "server/handlers/sequence_forms.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/base/elapsed.h"
#include "protocol/sequence/sequence.h"
#include "protocol/spec/traits.h"
#include "server/handlers/event_reply.h"

namespace gnomon {
namespace {

/// A file of the reply.
struct SentFile {
  std::string name;
  std::string_view contentType;
  std::string_view bytes;
};

/// "frame-00012.png"; with its view where the frame has several pictures: "frame-00012-depth.png".
std::string pictureName(const DoneFrame& frame, const PictureNews& picture) {
  std::array<char, 32> number;
  const int length = std::snprintf(number.data(), number.size(), "frame-%05d", frame.index);
  std::string name(number.data(), static_cast<std::size_t>(length));
  if (frame.pictures.list().size() > 1) name += "-" + picture.view;
  const auto traits = std::find_if(kFormatTraits.begin(), kFormatTraits.end(),
                                   [&](const FormatTraits& format) { return format.mediaType == picture.contentType; });
  return traits == kFormatTraits.end() ? name : name.append(traits->suffix);
}

/// A frame's pictures, each with its bytes.
template <class Send>
bool eachPicture(const DoneFrame& frame, Send&& send) {
  return frame.pictures.each([&](const PictureNews& picture, std::string_view bytes) {
    return send(picture, SentFile{pictureName(frame, picture), picture.contentType, bytes});
  });
}

class MultipartForm final : public SequenceForm {
 public:
  explicit MultipartForm(std::string boundary) : boundary_(std::move(boundary)) {}

  bool frame(const BodySink& sink, const DoneFrame& frame, int) override {
    return pictures(sink, frame, "\r\nGnomon-Carried: " + jsonText(toJson(frame.carried)));
  }
  bool pictures(const BodySink& sink, const DoneFrame& frame, const std::string& more) const {
    return eachPicture(frame, [&](const PictureNews& picture, const SentFile& file) {
      return part(sink, file,
                  "\r\nGnomon-Frame: " + std::to_string(frame.index) + "\r\nGnomon-View: " + picture.view + more);
    });
  }
  bool end(const BodySink& sink) const { return sink("--" + boundary_ + "--\r\n"); }
  bool report(const BodySink& sink, std::string_view json) override {
    return part(sink, {"report.json", "application/json", json}, "") && end(sink);
  }
  bool problem(const BodySink& sink, std::string_view json) override {
    return part(sink, {"problem.json", "application/problem+json", json}, "") && end(sink);
  }

 private:
  bool part(const BodySink& sink, const SentFile& file, const std::string& more) const {
    std::string head = "--" + boundary_ + "\r\nContent-Type: ";
    head.append(file.contentType).append("\r\nContent-Disposition: attachment; filename=\"").append(file.name);
    head.append("\"\r\nContent-Length: ").append(std::to_string(file.bytes.size())).append(more).append("\r\n\r\n");
    return sink(head) && sink(file.bytes) && sink("\r\n");
  }

  const std::string boundary_;
};

class ZipForm final : public SequenceForm {
 public:
  bool frame(const BodySink& sink, const DoneFrame& frame, int) override {
    return eachPicture(frame, [&](const PictureNews&, const SentFile& file) { return add(sink, file); });
  }
  bool report(const BodySink& sink, std::string_view json) override {
    return add(sink, {"report.json", "application/json", json}) && sink(zip_.end());
  }
  bool problem(const BodySink& sink, std::string_view json) override {
    return add(sink, {"problem.json", "application/problem+json", json}) && sink(zip_.end());
  }

 private:
  bool add(const BodySink& sink, const SentFile& file) {
    return sink(zip_.head(file.name, static_cast<std::uint32_t>(file.bytes.size()), crc32Of(asBytes(file.bytes)))) &&
           sink(file.bytes); // a frame's pictures have less than 2 GB
  }

  ZipStream zip_;
};

/// Sends bytes as base64, a piece at a time: a client that reads slowly holds no copy of them all.
bool sendBase64(const BodySink& sink, std::string_view bytes) {
  constexpr std::size_t kPiece = 3 * 16'384; // whole groups, so that the texts join
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPiece, bytes.size()))) {
    if (!sink(base64Text(asBytes(bytes.substr(0, kPiece))))) return false;
  }
  return true;
}

class EventForm final : public SequenceForm {
 public:
  bool begin(const BodySink& sink) override { return sink(":\n\n"); }
  std::string_view heartbeat() const override { return ":\n\n"; }
  bool frame(const BodySink& sink, const DoneFrame& frame, int of) override {
    SequenceFrame described{
        .index = frame.index, .of = of, .carried = frame.carried, .stages = frame.result.outcome.stages};
    for (const PictureNews& picture : frame.pictures.list())
      described.images.push_back({picture.view, picture.contentType, ""});
    const std::string event = eventText("frame", jsonText(toJson(described)));
    std::string_view rest = event;
    const bool isThere = eachPicture(frame, [&](const PictureNews&, const SentFile& file) {
      constexpr std::string_view kData = R"("data":")"; // no text of JSON holds it: its quotes would be escaped
      const std::string_view before = rest.substr(0, rest.find(kData) + kData.size());
      rest.remove_prefix(before.size());
      return sink(before) && sendBase64(sink, file.bytes);
    });
    return isThere && sink(rest);
  }
  bool report(const BodySink& sink, std::string_view json) override { return sink(eventText("result", json)); }
  bool problem(const BodySink& sink, std::string_view json) override { return sink(eventText("problem", json)); }
};

std::unique_ptr<SequenceForm> formOf(std::string_view mediaType, const std::string& boundary) {
  if (mediaType == "application/zip") return std::make_unique<ZipForm>();
  if (mediaType == kEventStream) return std::make_unique<EventForm>();
  return std::make_unique<MultipartForm>(boundary);
}

std::string boundaryFor(const RouteCall& call) {
  Sha256 hash; // of what no picture holds by chance
  hash.add(call.request.id + call.request.trace.traceId);
  return "gnomon-" + hash.hex().substr(0, 32);
}

std::string multipartType(const std::string& boundary) {
  return "multipart/mixed; boundary=" + boundary;
}

/// Adds a frame to the report.
void note(const DoneFrame& frame, SequenceReport& report) {
  constexpr std::size_t kMostWarnings = 32;
  report.frames.push_back({frame.index, frame.milliseconds, frame.result.outcome.stages});
  report.carried = frame.carried;
  for (const std::string& warning : frame.warnings) {
    const bool isKnown = std::find(report.warnings.begin(), report.warnings.end(), warning) != report.warnings.end();
    if (!isKnown && report.warnings.size() < kMostWarnings) report.warnings.push_back(warning);
  }
}

/// A reply that sends frames, from one wait for a frame to the next.
class SequenceStream {
 public:
  SequenceStream(std::shared_ptr<SequenceForm> form, std::shared_ptr<FrameSource> frames,
                 std::optional<DoneFrame> first, SequenceReport report, std::string requestId)
      : form_(std::move(form)),
        frames_(std::move(frames)),
        first_(std::move(first)),
        report_(std::move(report)),
        requestId_(std::move(requestId)),
        before_(first_ ? first_->milliseconds : 0) {}

  /// What the next frame waits for; nullptr at the end, whatever that is.
  std::shared_ptr<ReplyWait> goOn(const BodySink& sink) {
    if (!start_) {
      start_ = Clock::now();
      isThere_ = form_->begin(sink);
    }
    while (isThere_ && !isOver_) {
      if (!first_) {
        if (auto wait = frames_->wait(form_->heartbeat())) return wait;
      }
      sendNext(sink);
    }
    return nullptr; // the connection notes why not everything was sent
  }

  std::shared_ptr<const StreamResult> result() const { return result_; }

 private:
  void sendNext(const BodySink& sink) {
    const auto waiting = [&] { isThere_ = isThere_ && (form_->heartbeat().empty() || sink(form_->heartbeat())); };
    DoneFrame frame = first_ ? *std::exchange(first_, std::nullopt) : frames_->next(waiting);
    if (frame.problems.empty())
      if (auto encoded = form_->encode(frame); !encoded) frame.problems = encoded.problems();
    if (!frame.problems.empty()) {
      form_->problem(sink, problemText(frame.problems, requestId_));
      result_->problem = frame.problems.front().detail;
      result_->refusal = refusalOfStatus(statusOf(frame.problems.front().code));
      isOver_ = true;
      return;
    }
    note(frame, report_);
    isThere_ = form_->frame(sink, frame, frames_->count()) && isThere_;
    if (!isThere_ || !frames_->atEnd()) return;
    report_.milliseconds = before_ + millisecondsSince(*start_);
    form_->report(sink, jsonText(toJson(report_)));
    isOver_ = true;
  }

  const std::shared_ptr<SequenceForm> form_;
  const std::shared_ptr<FrameSource> frames_;
  std::optional<DoneFrame> first_;
  SequenceReport report_;
  const std::string requestId_;
  const double before_; ///< milliseconds
  const std::shared_ptr<StreamResult> result_ = std::make_shared<StreamResult>();
  std::optional<Clock::time_point> start_;
  bool isThere_ = true; ///< the client
  bool isOver_ = false;
};

} // namespace

TypedForm sequenceForm(std::string_view mediaType, const RouteCall& call) {
  const std::string boundary = boundaryFor(call);
  const bool isMultipart = mediaType == kSequenceForms.front();
  return {isMultipart ? multipartType(boundary) : std::string(mediaType), formOf(mediaType, boundary)};
}

HttpReply frameReply(const DoneFrame& frame, const RouteCall& call) {
  HttpReply reply;
  if (frame.pictures.list().size() == 1) {
    reply.contentType = frame.pictures.list().front().contentType;
    reply.body = frame.pictures.bytes();
    return reply;
  }
  const std::string boundary = boundaryFor(call);
  reply.contentType = multipartType(boundary);
  std::string body;
  const BodySink sink = [&](std::string_view piece) {
    body += piece;
    return true;
  };
  MultipartForm form(boundary);
  form.pictures(sink, frame, "");
  form.end(sink);
  reply.body = std::move(body);
  return reply;
}

HttpReply sequenceReply(TypedForm form, const RouteCall& call, std::shared_ptr<FrameSource> frames,
                        std::optional<DoneFrame> first, SequenceReport report) {
  HttpReply reply;
  reply.contentType = std::move(form.contentType);
  reply.headers.emplace_back("X-Accel-Buffering", "no");   // asks proxies to pass frames on at once
  reply.headers.emplace_back("Cache-Control", "no-store"); // it contains times
  reply.headers.emplace_back("Vary", "Accept");
  const auto stream = std::make_shared<SequenceStream>(std::move(form.form), std::move(frames), std::move(first),
                                                       std::move(report), call.request.id);
  reply.streamed = stream->result();
  reply.stream = [stream](const BodySink& sink) { return stream->goOn(sink); };
  return reply;
}

} // namespace gnomon
