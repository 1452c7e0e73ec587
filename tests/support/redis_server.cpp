#include "tests/support/redis_server.h"

#include <arpa/inet.h>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::testing {
namespace {

namespace fs = std::filesystem;

fs::path newDirectory() {
  std::string pattern = (fs::temp_directory_path() / "gnomon-redis-XXXXXX").string();
  return ::mkdtemp(pattern.data());
}

void runCommand(const std::string& line) {
  if (std::system((line + " >/dev/null 2>&1").c_str()) != 0) throw std::runtime_error("This command failed: " + line);
}

/// An authority, "ca.pem", and a certificate of it for a name, "server.pem" with "server.key".
void makeCertificates(const fs::path& directory, const std::string& name) {
  const std::string in = "cd " + directory.string() + " && ";
  const std::string key = "-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes ";
  runCommand(in + "openssl req -x509 " + key + "-keyout ca.key -out ca.pem -days 2 -subj /CN=authority");
  runCommand(in + "openssl req " + key + "-keyout server.key -out server.csr -subj /CN=redis");
  runCommand(in + "printf 'subjectAltName=" + name +
             "' > names && openssl x509 -req -in server.csr -CA ca.pem -CAkey " +
             "ca.key -CAcreateserial -days 2 -extfile names -out server.pem");
}

/// Reads what a program prints until the words come. False where it ends before, or after some seconds.
bool waitForWords(int pipe, const std::string& words) {
  constexpr int kPatience = 10'000; // milliseconds
  std::string seen;
  pollfd waiting{pipe, POLLIN, 0};
  while (seen.find(words) == std::string::npos) {
    char piece[4096];
    const ssize_t count = ::poll(&waiting, 1, kPatience) == 1 ? ::read(pipe, piece, sizeof piece) : 0;
    if (count <= 0) return false;
    seen.append(piece, static_cast<std::size_t>(count));
  }
  return true;
}

} // namespace

std::uint16_t freePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const general = reinterpret_cast<sockaddr*>(&address);
  const bool known = ::bind(socket, general, size) == 0 && ::getsockname(socket, general, &size) == 0;
  ::close(socket);
  if (!known) throw std::runtime_error("No port is free.");
  return ::ntohs(address.sin_port);
}

bool RedisServer::isInstalled() {
  return std::system("command -v redis-server >/dev/null 2>&1") == 0;
}

RedisServer::RedisServer(std::vector<std::string> arguments) : RedisServer(std::move(arguments), std::nullopt) {}

std::unique_ptr<RedisServer> RedisServer::encrypted(const std::string& name) {
  return std::unique_ptr<RedisServer>(new RedisServer({}, WithTls{name}));
}

RedisServer::RedisServer(std::vector<std::string> arguments, std::optional<WithTls> tls)
    : directory_(newDirectory()), arguments_(std::move(arguments)), isEncrypted_(tls.has_value()), port_(freePort()) {
  if (tls) makeCertificates(directory_, tls->name);
  start();
}

RedisServer::~RedisServer() {
  kill();
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
}

std::string RedisServer::url(const std::string& userPart) const {
  return (isEncrypted_ ? "rediss://" : "redis://") + userPart + "127.0.0.1:" + std::to_string(port_);
}

void RedisServer::start() {
  std::vector<std::string> all{"redis-server",
                               isEncrypted_ ? "--tls-port" : "--port",
                               std::to_string(port_),
                               "--bind",
                               "127.0.0.1",
                               "--dir",
                               directory_.string(),
                               "--appendonly",
                               "yes",
                               "--appendfsync",
                               "always",
                               "--save",
                               ""};
  if (isEncrypted_) {
    const std::string at = directory_.string() + "/";
    for (const std::string& more :
         {std::string("--port"), std::string("0"), std::string("--tls-cert-file"), at + "server.pem",
          std::string("--tls-key-file"), at + "server.key", std::string("--tls-ca-cert-file"), at + "ca.pem",
          std::string("--tls-auth-clients"), std::string("no")}) {
      all.push_back(more);
    }
  }
  all.insert(all.end(), arguments_.begin(), arguments_.end());
  std::vector<char*> words;
  for (std::string& word : all) words.push_back(word.data());
  words.push_back(nullptr);
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) throw std::runtime_error("No pipe.");
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(pipe[1], STDOUT_FILENO);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  const bool isReady = waitForWords(pipe[0], "Ready to accept connections");
  ::close(pipe[0]);
  if (!isReady) {
    kill();
    throw std::runtime_error("redis-server did not start.");
  }
}

void RedisServer::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

void RedisServer::suspend() {
  ::kill(process_, SIGSTOP);
}

void RedisServer::resume() {
  ::kill(process_, SIGCONT);
}

} // namespace gnomon::testing
