#include "tests/bench/gnomon_process.h"

#include <chrono>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <httplib.h>
#include <sched.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include "protocol/base/elapsed.h"
#include "tests/bench/tools.h"

namespace gnomon::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPatienceSeconds = 120;

std::vector<std::string> environmentOf(const Program& program) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    if (!std::string_view(*entry).starts_with("GNOMON_")) all.emplace_back(*entry);
  }
  if (!program.instructionSet.empty()) all.push_back("GNOMON_CPU_TARGET=" + program.instructionSet);
  return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts it with its standard output at `output`, its messages nowhere.
pid_t start(const Program& program, std::vector<std::string> arguments, int output) {
  arguments.insert(arguments.begin(), program.file.string());
  std::vector<std::string> environment = environmentOf(program);
  const std::vector<char*> argv = pointersTo(arguments);
  const std::vector<char*> envp = pointersTo(environment);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int i = 0; i < program.cores; ++i) CPU_SET(static_cast<std::size_t>(i), &cores);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t child = fork();
  if (child == 0) { // nothing but system calls: other threads may have held any lock
    dup2(output, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    if (program.cores == 0 || sched_setaffinity(0, sizeof cores, &cores) == 0)
      execve(argv[0], argv.data(), envp.data());
    _exit(127);
  }
  close(nowhere);
  if (child < 0) throw std::runtime_error("no process can be started");
  return child;
}

bool endedWell(pid_t child) {
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A server and its workers.
std::vector<pid_t> withChildren(pid_t process) {
  std::vector<pid_t> all{process};
  for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream children(thread.path() / "children");
    for (pid_t child = 0; children >> child;) all.push_back(child);
  }
  return all;
}

double processorTime(pid_t process) {
  clockid_t clock;
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// The line that a server prints once it takes requests; empty where it ends first.
std::string firstLine(int file) {
  std::string line;
  char letter = 0;
  while (read(file, &letter, 1) == 1 && letter != '\n') line += letter;
  return line;
}

} // namespace

struct Connection::Client {
  explicit Client(const std::string& origin) : http(origin) {
    http.set_keep_alive(true);
    http.set_tcp_nodelay(true);
    http.set_read_timeout(kPatienceSeconds);
  }
  httplib::Client http;
};

namespace {

const std::string& bodyOf(const httplib::Result& reply) {
  if (!reply) throw std::runtime_error("no reply: " + httplib::to_string(reply.error()));
  if (reply->status >= 300) throw std::runtime_error(reply->body);
  return reply->body;
}

} // namespace

Connection::Connection(const std::string& origin) : client_(std::make_unique<Client>(origin)) {}

Connection::~Connection() = default;

nlohmann::json Connection::get(const std::string& path) {
  return nlohmann::json::parse(bodyOf(client_->http.Get(path)));
}

std::string Connection::upload(const Bytes& glb) {
  const auto reply =
      client_->http.Post("/v1/scenes", reinterpret_cast<const char*>(glb.data()), glb.size(), "model/gltf-binary");
  return nlohmann::json::parse(bodyOf(reply)).at("id");
}

double Connection::draw(const std::string& scene, const nlohmann::json& spec) {
  const std::string body = spec.dump();
  const auto begin = Clock::now();
  const auto reply =
      client_->http.Post("/v1/scenes/" + scene + "/frames", {{"Accept", "image/png"}}, body, "application/json");
  const double time = millisecondsSince(begin);
  bodyOf(reply);
  return time;
}

Server::Server(const Program& program) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
  const auto begin = Clock::now();
  process_ = start(program,
                   {"serve", "--port", "0", "--device", program.device, "--workers", std::to_string(program.workers),
                    "--reply-cache-bytes", "0"},
                   ends[1]);
  close(ends[1]);
  const std::string line = firstLine(ends[0]);
  close(ends[0]);
  constexpr std::string_view kBefore = "listening on ";
  if (!line.starts_with(kBefore)) {
    waitpid(process_, nullptr, 0);
    throw std::runtime_error("the server for " + program.device + " did not start");
  }
  origin_ = line.substr(kBefore.size());
  httplib::Client client(origin_);
  for (;;) {
    const auto reply = client.Get("/readyz");
    if (reply && reply->status == 200) break;
    if (millisecondsSince(begin) > 1000.0 * kPatienceSeconds) throw std::runtime_error("the server does not get ready");
  }
  ready_ = millisecondsSince(begin);
}

Server::~Server() {
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

double Server::peakBytes() const {
  double bytes = 0;
  for (const pid_t each : withChildren(process_)) bytes += statusBytes(std::to_string(each), "VmHWM:");
  return bytes;
}

double Server::processorMilliseconds() const {
  double milliseconds = 0;
  for (const pid_t each : withChildren(process_)) milliseconds += processorTime(each);
  return milliseconds;
}

double renderMilliseconds(const Program& program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"render", "--device", program.device});
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const auto begin = Clock::now();
  const bool good = endedWell(start(program, arguments, nowhere));
  const double time = millisecondsSince(begin);
  close(nowhere);
  if (!good) throw std::runtime_error("gnomon render failed");
  return time;
}

} // namespace gnomon::bench
