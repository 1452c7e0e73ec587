#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <map>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "server/system/file_descriptor.h"
#include "server/wire/answers.h"
#include "server/wire/channel.h"
#include "server/wire/messages.h"
#include "server/wire/sequence_news.h"
#include "server/worker/worker.h"
#include "tests/server/worker/escapes.h"

/// A worker that goes wrong on request: a real one behind a relay that looks for the name of a fault, or of a lie, in
/// the text of each order. What has none is carried out as ever.
namespace gnomon {
namespace {

/// Shared memory, which no limit of allocations bounds (RLIMIT_DATA).
[[noreturn]] void eatMemory() {
  constexpr std::size_t kBite = 16 << 20;
  while (true) {
    void* const bite = ::mmap(nullptr, kBite, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (bite != MAP_FAILED) std::memset(bite, 'x', kBite);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// A result of the type that was asked for.
void sendResult(Channel& front, const Order& order, const FileDescriptor& file) {
  front.send(textOf(ToFront{.outcome = Outcome{.number = order.number, .contentType = resultType(order)}}),
             std::array{file.get()});
}

/// Everything that a worker which was taken over may try, on the thread that was first: the system's rules for files
/// are those of a thread and of all that it starts. What succeeds is a line in the log.
void tryEscapes(int) {
  const char* secret = std::getenv("TEST_SECRET");
  for (const Escape& escape : escapes()) {
    if (succeeds(escape, ::getppid(), secret == nullptr ? "" : secret))
      std::fprintf(stderr, "escape: could %s\n", escape.what);
  }
  std::fputs("escape: tried all\n", stderr);
}

void sendNews(Channel& front, const Order& order, std::vector<PictureNews> pictures) {
  const std::string news = textOf(SequenceNews{.pictures = std::move(pictures)});
  front.send(textOf(ToFront{.event = OrderEvent{order.number, std::string(kSequenceNews), news}}));
}

FileDescriptor unsealedFile(off_t size) {
  FileDescriptor file(::memfd_create("lie", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  return ::ftruncate(file.get(), size) == 0 ? std::move(file) : FileDescriptor();
}

/// Nothing but its size.
FileDescriptor hollowFile() {
  FileDescriptor file = unsealedFile(1 << 30);
  ::fcntl(file.get(), F_ADD_SEALS, F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE);
  return file;
}

FileDescriptor pipeOf(std::string_view bytes) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  const FileDescriptor writing(ends[1]);
  writeAll(writing, asBytes(bytes));
  return FileDescriptor(ends[0]);
}

FileDescriptor sealedFile(std::string_view bytes) {
  return *memoryFile(asBytes(bytes));
}

/// Three events of an evaluation, and then the end.
[[noreturn]] void abortAfterEvents(Channel& front, const Order& order) {
  for (int done = 0; done < 3; ++done) {
    front.send(textOf(ToFront{.event = OrderEvent{order.number, "progress", std::to_string(done)}}));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100)); // until they are sent on
  std::abort();
}

using Fault = std::function<void(Channel& front, const Order& order)>;

/// What a worker does whose parser was taken over, beside the order that it was given.
const std::map<std::string, Fault> kFaults{
    {"fault-abort", [](Channel&, const Order&) { std::abort(); }},
    {"fault-loop", [](Channel&, const Order&) {}}, // neither carried out nor stopped
    {"fault-memory", [](Channel&, const Order&) { eatMemory(); }},
    {"fault-silence", [](Channel&, const Order&) { std::raise(SIGSTOP); }},
    // The order is never carried out.
    {"fault-escape", [](Channel&, const Order&) { ::syscall(SYS_tgkill, ::getpid(), ::getpid(), SIGUSR1); }},
    {"fault-events", abortAfterEvents},
    {"fault-garbage", [](Channel& front, const Order&) { front.send("{\"outcome\": [}"); }},
    {"lie-pipe", [](Channel& front, const Order& order) { sendResult(front, order, pipeOf("bytes")); }},
    {"lie-eventfd",
     [](Channel& front, const Order& order) { sendResult(front, order, FileDescriptor(::eventfd(1, 0))); }},
    {"lie-unsealed", [](Channel& front, const Order& order) { sendResult(front, order, unsealedFile(5)); }},
    {"lie-hollow", [](Channel& front, const Order& order) { sendResult(front, order, hollowFile()); }},
    {"lie-nothing",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.outcome = Outcome{.number = order.number, .contentType = resultType(order)}}));
     }},
    {"lie-type",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.outcome = Outcome{.number = order.number, .contentType = "text/html"}}),
                  std::array{sealedFile("<p>").get()});
     }},
    {"lie-head",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.outcome = Outcome{.number = order.number,
                                                    .contentType = resultType(order),
                                                    .stages = {{"shade\r\nSet-Cookie: a=b", 1}}}}),
                  std::array{sealedFile("bytes").get()});
     }},
    {"lie-number",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.outcome = Outcome{.number = order.number + 1'000'000, .problems = {Problem{}}}}));
     }},
    {"lie-finished",
     [](Channel& front, const Order&) {
       front.send(textOf(ToFront{.event = OrderEvent{0, "progress", "{}"}}));
     }},
    {"lie-refusal", [](Channel& front, const Order&) { front.send(textOf(ToFront{.refusal = Refusal{}})); }},
    {"lie-start", [](Channel& front, const Order&) { front.send(textOf(ToFront{.ready = RendererInfo{}})); }},
    {"lie-map",
     [](Channel& front, const Order&) {
       const std::string key = std::string(64, 'a') + "-" + std::string(64, 'b');
       front.send(textOf(ToFront{.made = LightMapMade{key}}), std::array{sealedFile("map").get()});
     }},
    {"lie-own-map",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.made = LightMapMade{order.scene + "-" + std::string(64, 'b')}}),
                  std::array{pipeOf("map").get()});
     }},
    {"lie-giant",
     [](Channel&, const Order&) {
       std::string text(40'000, 'i'); // more than a packet has
       iovec content{text.data(), text.size()};
       msghdr message{};
       message.msg_iov = &content;
       message.msg_iovlen = 1;
       ::sendmsg(kWorkerChannel, &message, 0); // the sandbox knows no send(2)
     }},
    {"lie-wrap",
     [](Channel& front, const Order& order) { // 5 = 2^64 - 1 + 6
       sendNews(front, order, {{"color", "image/png", ~std::uint64_t{0}}, {"depth", "image/png", 6}});
       sendResult(front, order, sealedFile("12345"));
     }},
    {"lie-short",
     [](Channel& front, const Order& order) {
       sendNews(front, order, {{"color", "image/png", 6}});
       sendResult(front, order, sealedFile("12345"));
     }},
    {"lie-view",
     [](Channel& front, const Order& order) {
       sendNews(front, order, {{"color\r\nX: y", "image/png", 5}});
       sendResult(front, order, sealedFile("12345"));
     }},
    {"lie-damaged",
     [](Channel& front, const Order& order) {
       front.send(textOf(ToFront{.outcome = Outcome{.number = order.number, .damaged = true}}));
     }},
};

/// True where the order's text names a fault, which has happened then.
bool happened(const Packet& packet, Channel& front) {
  const auto message = readToWorker(packet.text);
  if (!message || !message->order || packet.files.size() != 2) return false;
  const Bytes request = readFile(packet.files[1], kLimits.maxSpecBytes).value_or(Bytes());
  for (const auto& [name, fault] : kFaults) {
    if (asText(request).find(name) == std::string_view::npos) continue;
    fault(front, *message->order);
    return true;
  }
  return false;
}

void relay(Channel& from, Channel& to, const std::function<bool(const Packet&)>& isTaken) {
  while (true) {
    Packet packet;
    const ChannelEvent event = from.receive(packet, std::chrono::seconds(1));
    if (event == ChannelEvent::timeout) continue;
    if (event != ChannelEvent::packet) ::_exit(0);
    if (isTaken(packet)) continue;
    std::vector<int> files;
    for (const FileDescriptor& file : packet.files) files.push_back(file.get());
    if (!to.send(packet.text, files)) ::_exit(0);
  }
}

void runFaultyWorker() {
  constexpr std::chrono::seconds kPatience{10};
  auto ends = Channel::pair();
  if (!ends) ::_exit(1);
  Channel front(FileDescriptor(kWorkerChannel), kPatience);
  Channel worker(std::move(ends->first), kPatience);
  std::thread([&] { relay(worker, front, [](const Packet&) { return false; }); }).detach();
  std::thread([&] { relay(front, worker, [&](const Packet& packet) { return happened(packet, front); }); }).detach();
  runWorker(std::move(ends->second));
}

} // namespace
} // namespace gnomon

int main() {
  std::signal(SIGUSR1, gnomon::tryEscapes);
  gnomon::runFaultyWorker();
}
