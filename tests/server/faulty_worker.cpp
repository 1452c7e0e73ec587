#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "server/system/file_descriptor.h"
#include "server/wire/channel.h"
#include "server/wire/messages.h"
#include "server/worker/worker.h"
#include "tests/server/worker/escapes.h"

/// A worker that goes wrong on request: a real one behind a relay that looks for the name of a fault in the text of
/// each order. What has none is carried out as ever.
namespace gnomon {
namespace {

[[noreturn]] void eatMemory() {
  constexpr std::size_t kBite = 16 << 20;
  std::vector<std::vector<char>> eaten;
  while (true) {
    eaten.emplace_back(kBite, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void sendGarbage(Channel& front) {
  front.send("{\"outcome\": [}");
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

void escape(Channel&) {
  ::syscall(SYS_tgkill, ::getpid(), ::getpid(), SIGUSR1);
} // and the order is never carried out

void swallow(Channel&) {} // neither carried out nor stopped

const std::map<std::string, void (*)(Channel&)> kFaults{
    {"fault-abort", [](Channel&) { std::abort(); }},
    {"fault-loop", swallow},
    {"fault-memory", [](Channel&) { eatMemory(); }},
    {"fault-silence", [](Channel&) { std::raise(SIGSTOP); }},
    {"fault-garbage", sendGarbage},
    {"fault-escape", escape},
};

/// True where the order's text names a fault, which has happened then.
bool happened(const Packet& packet, Channel& front) {
  const auto message = readToWorker(packet.text);
  if (!message || !message->order || packet.files.size() != 2) return false;
  const Bytes request = readFile(packet.files[1], kLimits.maxSpecBytes).value_or(Bytes());
  for (const auto& [name, fault] : kFaults) {
    if (asText(request).find(name) == std::string_view::npos) continue;
    fault(front);
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
