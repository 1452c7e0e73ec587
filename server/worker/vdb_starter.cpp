#include "server/worker/vdb_starter.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sstream>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gnomon {
namespace {

/// A reader at the other end of a socket: it is killed when this end is closed, and its end arrives as a number.
class DistantVdb : public VdbProcess {
 public:
  explicit DistantVdb(FileDescriptor control) : control_(std::move(control)) {}

  int wait() override {
    int status = SIGKILL; // of a starter that is gone
    while (::read(control_.get(), &status, sizeof status) < 0 && errno == EINTR) {
    }
    return status;
  }

 private:
  FileDescriptor control_;
};

/// Starts the reader and stays until it has ended, or its caller has.
[[noreturn]] void attend(const std::string& text, const std::vector<FileDescriptor>& files) {
  std::vector<std::filesystem::path> programs;
  std::istringstream lines(text);
  std::string line, name;
  std::getline(lines, name);
  while (std::getline(lines, line)) programs.emplace_back(line);
  const int control = files[2].get();
  ::signal(SIGCHLD, SIG_DFL);
  int status = 127 << 8; // a shell's status for what can't be started
  auto reader = startVdbAsChild(programs, name, files[0].get(), files[1].get());
  ::close(files[1].get()); // its end is the end of the voxels
  if (reader) {
    std::thread([control] {
      pollfd waiting{control, POLLIN, 0};
      ::poll(&waiting, 1, -1);
      ::kill(0, SIGKILL); // this process and the reader, which are a group
    }).detach();
    status = reader->wait();
  }
  [[maybe_unused]] const auto written = ::send(control, &status, sizeof status, MSG_NOSIGNAL);
  ::_exit(0);
}

/// The starter's process.
[[noreturn]] void serve(Channel channel) {
  ::signal(SIGCHLD, SIG_IGN); // its children are not waited for
  while (true) {
    Packet packet;
    const ChannelEvent event = channel.receive(packet, std::chrono::seconds(10));
    if (event == ChannelEvent::timeout) continue;
    if (event != ChannelEvent::packet || packet.files.size() != 3) ::_exit(0);
    if (::fork() != 0) continue;
    ::setpgid(0, 0);
    attend(packet.text, packet.files);
  }
}

} // namespace

std::unique_ptr<VdbStarter> VdbStarter::start() {
  auto ends = Channel::pair();
  if (!ends) return nullptr;
  const pid_t child = ::fork();
  if (child < 0) return nullptr;
  if (child == 0) {
    ends->first.reset();
    ::syscall(SYS_close_range, 3, static_cast<unsigned>(ends->second.get()) - 1, 0); // the worker's channel among them
    serve(Channel(std::move(ends->second)));
  }
  return std::unique_ptr<VdbStarter>(new VdbStarter(std::move(ends->first)));
}

std::unique_ptr<VdbProcess> VdbStarter::startVdb(VdbPrograms programs, const std::string& name, int input, int output) {
  std::array<int, 2> control{};
  if (name.find('\n') != std::string::npos) return nullptr;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, control.data()) != 0) return nullptr;
  FileDescriptor own(control[0]);
  const FileDescriptor given(control[1]);
  std::string text = name;
  for (const std::filesystem::path& program : programs) text += "\n" + program.string();
  if (!channel_.send(text, std::array{input, output, given.get()})) return nullptr;
  return std::make_unique<DistantVdb>(std::move(own));
}

} // namespace gnomon
