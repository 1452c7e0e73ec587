// What a worker says to an order, and what Redis says of a frame, through every form of a reply: whatever is taken
// makes heads without control characters, and bodies of which each byte is one of its pictures once.
#include <algorithm>
#include <array>

#include "server/handlers/event_reply.h"
#include "server/handlers/outcome_reply.h"
#include "server/handlers/sequence_forms.h"
#include "server/jobs/job_text.h"
#include "server/wire/answers.h"
#include "server/wire/frame_pictures.h"
#include "tests/fuzz/require.h"

namespace {

using namespace gnomon;

void requirePlain(std::string_view head) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    const auto c = static_cast<unsigned char>(head[i]);
    const bool isLineEnd = (c == '\r' && head.substr(i, 2) == "\r\n") || (c == '\n' && i > 0 && head[i - 1] == '\r');
    fuzz::require(c >= 0x20 || isLineEnd, "a head has no control characters");
  }
}

/// Frames that are there already.
class Known final : public FrameSource {
 public:
  explicit Known(DoneFrame frame) : frame_(std::move(frame)) {}
  bool atEnd() const override { return isGiven_; }
  int count() const override { return 1; }
  DoneFrame next(const std::function<void()>&) override {
    isGiven_ = true;
    return std::move(frame_);
  }

 private:
  DoneFrame frame_;
  bool isGiven_ = false;
};

std::string sentAs(std::string_view form, DoneFrame frame) {
  RouteCall call;
  call.request.id = "id";
  const HttpReply reply =
      sequenceReply(sequenceForm(form, call), call, std::make_shared<Known>(std::move(frame)), std::nullopt, {});
  requirePlain(replyHead(reply, "id", true));
  std::string body;
  reply.stream([&](std::string_view piece) {
    body += piece;
    return true;
  });
  return body;
}

DoneFrame doneFrame(const FramePictures& pictures, const std::vector<StageTime>& stages) {
  DoneFrame frame{.pictures = pictures};
  frame.result.outcome.stages = stages;
  return frame;
}

/// The lines between a boundary and the empty line behind it, of each part; and the bytes of all parts together.
void requireParts(std::string_view body, const FramePictures& pictures) {
  std::size_t parts = 0;
  for (std::size_t at = body.find("--gnomon-"); at != std::string_view::npos && parts < pictures.list().size();
       ++parts) {
    const std::size_t end = body.find("\r\n\r\n", at);
    fuzz::require(end != std::string_view::npos, "a part has a head");
    requirePlain(body.substr(at, end - at));
    const auto lines = std::count(body.begin() + static_cast<std::ptrdiff_t>(at),
                                  body.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    fuzz::require(lines == 6, "which is of the lines that the front wrote");
    at = end + 4 + pictures.list()[parts].bytes + 2;
    fuzz::require(body.substr(at, 9) == "--gnomon-", "and bytes of the length that it says");
  }
  fuzz::require(parts == pictures.list().size(), "each picture is a part");
}

void requireSoundForms(const FramePictures& pictures, const std::vector<StageTime>& stages) {
  std::size_t bytes = 0;
  fuzz::require(pictures.each([&](const PictureNews& picture, std::string_view own) {
    bytes += own.size();
    return own.size() == picture.bytes;
  }) && bytes == pictures.bytes().size(),
                "sizes add up");
  requireParts(sentAs("multipart/mixed", doneFrame(pictures, stages)), pictures);
  fuzz::require(sentAs("application/zip", doneFrame(pictures, stages)).starts_with("PK"), "a ZIP is one");
  const std::string events = sentAs(kEventStream, doneFrame(pictures, stages));
  const auto names = [&](std::string_view name) {
    std::size_t count = 0;
    for (auto at = events.find(name); at != std::string::npos; at = events.find(name, at + 1)) ++count;
    return count;
  };
  fuzz::require(names("\nevent: ") == 2, "there is no event but those of the front");
  const HttpReply one = frameReply(doneFrame(pictures, stages), RouteCall());
  requirePlain(replyHead(one, "id", true));
}

/// Bytes of the size that the pictures have; nothing where that is much.
std::optional<FramePictures> filled(const std::vector<PictureNews>& pictures, std::size_t more) {
  constexpr std::size_t kMost = 1 << 16;
  const std::size_t size = bytesOf(pictures).value_or(0) + more;
  if (size > kMost) return std::nullopt;
  auto made = FramePictures::of(pictures, Bytes(size, 'x'));
  fuzz::require(bool(made) == (more == 0 && bytesOf(pictures)), "pictures have their bytes, or are none");
  return made ? std::optional(*std::move(made)) : std::nullopt;
}

void requireSoundReply(const Outcome& outcome, const std::optional<SharedBytes>& body) {
  const HttpReply reply = replyOf({outcome, body}, "id");
  requirePlain(replyHead(reply, "id", true));
  fuzz::require(outcome.problems.empty() || reply.status >= 400, "a problem is one");
}

constexpr std::array kKinds{OrderKind::load,       OrderKind::frame,         OrderKind::plan,
                            OrderKind::evaluation, OrderKind::bake,          OrderKind::bakeFile,
                            OrderKind::nodes,      OrderKind::sequenceFrame, OrderKind::frame};
constexpr std::array<std::string_view, 4> kTypes{"image/png", "multipart/mixed", "application/json", kEventStream};

/// `lines`: a message to the front each, and at last a body.
void talk(std::uint8_t choice, std::string_view lines) {
  const Order order{.number = 1,
                    .kind = kKinds[choice % kKinds.size()],
                    .scene = std::string(64, 'a'),
                    .mediaType = std::string(kTypes[choice / kKinds.size() % kTypes.size()]),
                    .boundary = "gnomon-1"};
  Announced announced;
  std::vector<PictureNews> pictures;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const auto message = readToFront(lines.substr(0, end));
    lines = lines.substr(std::min(end + 1, lines.size()));
    if (!message) return; // such a worker is replaced
    if (message->event) {
      if (!maySend(order, *message->event, announced)) return;
      const std::string text = eventText(message->event->name, message->event->data);
      fuzz::require(std::count(text.begin(), text.end(), '\n') == 3, "an event is one");
      const auto news = order.kind == OrderKind::sequenceFrame ? readSequenceNews(message->event->data) : std::nullopt;
      if (news && !news->pictures.empty()) pictures = news->pictures;
    }
    if (!message->outcome) continue;
    const Outcome& outcome = *message->outcome;
    const bool isLarge = announced.pictureBytes && *announced.pictureBytes > 1 << 16;
    const SharedBytes body =
        announced.pictureBytes && !isLarge ? SharedBytes(Bytes(*announced.pictureBytes, 'x')) : SharedBytes(lines);
    if (!mayEnd(order, outcome, body, announced)) return;
    requireSoundReply(outcome, body);
    if (order.kind != OrderKind::sequenceFrame || !outcome.problems.empty() || outcome.damaged) return;
    const auto made = FramePictures::of(pictures, body);
    fuzz::require(bool(made), "what was announced is what came");
    return requireSoundForms(*made, outcome.stages);
  }
}

void readNote(std::uint8_t choice, std::string_view text) {
  const auto note = readFrameNote(text);
  if (!note) return;
  requirePlain('"' + note->contentKey + '"');
  const auto pictures = filled(note->pictures, choice % 4);
  if (pictures) requireSoundForms(*pictures, note->stages);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 0) {
    talk(data[0] / 2, text);
  } else {
    readNote(data[0] / 2, text);
  }
  return 0;
}
