#include "server/worker/vdb_starter.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/auxv.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "renderer/core/file_access.h"
#include "renderer/core/system_calls.h"

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

/// As a shell ends where a program can't be executed.
constexpr int kNotExecuted = 127;

/// The program that the starter has open takes this process's place, with a file, a pipe, and nothing else.
[[noreturn]] void becomeReader(std::string name, int input, int output, std::uint64_t bytes) {
  constexpr rlim_t kStack = 1 << 20; // of each thread that its libraries start
  const rlimit stack{kStack, kStack}, memory{bytes, bytes};
  const bool isReady = ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && // with the process that attends to it
                       ::setrlimit(RLIMIT_STACK, &stack) == 0 &&
                       (bytes == 0 || ::setrlimit(RLIMIT_DATA, &memory) == 0) &&
                       ::dup2(STDIN_FILENO, STDERR_FILENO) >= 0 && // /dev/null is the worker's input
                       ::dup2(input, STDIN_FILENO) >= 0 && ::dup2(output, STDOUT_FILENO) >= 0;
  std::string program = "gnomon_vdb";
  const std::array<char*, 3> arguments{program.data(), name.data(), nullptr};
  const std::array<char*, 1> environment{nullptr};
  if (isReady) ::syscall(SYS_execveat, kProgram, "", arguments.data(), environment.data(), AT_EMPTY_PATH);
  ::_exit(kNotExecuted);
}

/// Starts the reader and stays until it has ended, or its caller has: its own end kills it.
[[noreturn]] void attend(const Packet& packet, std::uint64_t bytes) {
  const int control = packet.files[2].get();
  sigset_t before, ended;
  sigemptyset(&ended);
  sigaddset(&ended, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &ended, &before);
  ::signal(SIGCHLD, [](int) {}); // ends the wait below
  const bool isTied = ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0;
  const pid_t reader = isTied ? ::fork() : -1;
  if (reader == 0) {
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    becomeReader(packet.text, packet.files[0].get(), packet.files[1].get(), bytes);
  }
  ::close(packet.files[1].get()); // its end is the end of the voxels
  int status = kNotExecuted << 8;
  while (reader > 0 && ::waitpid(reader, &status, WNOHANG) == 0) {
    pollfd caller{control, POLLIN, 0};
    if (::ppoll(&caller, 1, nullptr, &before) > 0) ::_exit(0);
  }
  [[maybe_unused]] const auto written = ::write(control, &status, sizeof status);
  ::_exit(0);
}

/// The starter's process.
[[noreturn]] void serve(Channel channel, std::uint64_t bytes) {
  while (true) {
    Packet packet;
    const ChannelEvent event = channel.receive(packet, std::chrono::seconds(10));
    if (event == ChannelEvent::timeout) continue;
    if (event != ChannelEvent::packet) ::_exit(0);
    if (packet.files.size() != 3 || !isGridName(packet.text)) continue; // no worker sends that
    const pid_t attendant = ::fork();
    if (attendant == 0) attend(packet, bytes);
    packet = {};
    if (attendant > 0) ::waitpid(attendant, nullptr, 0);
  }
}

/// The dynamic linker, by which this program runs and so does the other.
std::string linker() {
  Dl_info about{};
  const auto* begin = reinterpret_cast<const void*>(::getauxval(AT_BASE)); // NOLINT: an address of the kernel's
  return begin != nullptr && ::dladdr(begin, &about) != 0 ? about.dli_fname : "";
}

/// Opens the program as kProgram and gives up all that starting it does not take. False where the system refuses.
bool prepare(const std::optional<std::filesystem::path>& program) {
  if (program) {
    const FileDescriptor file(::open(program->c_str(), O_PATH | O_CLOEXEC));
    if (!file || ::dup3(file.get(), kProgram, O_CLOEXEC) < 0) return false;
  }
  std::array<FileGrant, 8> grants{FileGrant{linker(), FileUse::readAndStart},
                                  FileGrant{"/etc/ld.so.cache"},
                                  FileGrant{"/usr/lib"},
                                  FileGrant{"/usr/lib64"},
                                  FileGrant{"/usr/local/lib"},
                                  FileGrant{"/lib"},
                                  FileGrant{"/lib64"},
                                  FileGrant{}};
  if (program) grants.back() = {*program, FileUse::readAndStart};
  if (dropPrivileges() != 0 || ::prctl(PR_SET_DUMPABLE, 0) != 0) return false;
  const int error = keepFiles(grants);
  if (error != 0 && error != ENOSYS && error != EOPNOTSUPP) return false;
  return keepSystemCalls(Duty::start) == 0;
}

} // namespace

std::unique_ptr<VdbStarter> VdbStarter::start(const Options& options) {
  auto ends = Channel::pair();
  if (!ends) return nullptr;
  const pid_t worker = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return nullptr;
  if (child == 0) {
    ends->first.reset();
    const auto channel = static_cast<unsigned>(ends->second.get());
    ::syscall(SYS_close_range, 3, channel - 1, 0); // the worker's channel among them
    ::syscall(SYS_close_range, channel + 1, ~0u, 0);
    const bool isTied = ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == worker;
    ::signal(SIGPIPE, SIG_IGN); // NOLINT: an attendant whose caller is gone
    ::signal(SIGCHLD, SIG_DFL); // NOLINT
    if (!isTied || !prepare(options.program)) ::_exit(1);
    serve(Channel(std::move(ends->second)), options.readerBytes);
  }
  return std::unique_ptr<VdbStarter>(new VdbStarter(std::move(ends->first)));
}

std::unique_ptr<VdbProcess> VdbStarter::startVdb(const std::string& name, int input, int output) {
  std::array<int, 2> control{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, control.data()) != 0) return nullptr;
  FileDescriptor own(control[0]);
  const FileDescriptor given(control[1]);
  if (!channel_.send(name, std::array{input, output, given.get()})) return nullptr;
  return std::make_unique<DistantVdb>(std::move(own));
}

} // namespace gnomon
