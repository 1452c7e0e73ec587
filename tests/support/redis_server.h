#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace gnomon::testing {

/// A redis-server of a test's own, on a free port of 127.0.0.1, that keeps its data over a restart in a directory of
/// its own. It ends with this.
class RedisServer {
 public:
  /// Whether the system has the program; tests are skipped where it has not.
  static bool isInstalled();

  /// Starts it, with further arguments of its command line. Throws where it does not start.
  explicit RedisServer(std::vector<std::string> arguments = {});
  ~RedisServer();
  RedisServer(const RedisServer&) = delete;
  RedisServer& operator=(const RedisServer&) = delete;

  /// One that speaks TLS only, with a certificate for `name`, signed by an authority of its own.
  static std::unique_ptr<RedisServer> encrypted(const std::string& name);

  std::uint16_t port() const { return port_; }
  std::string url(const std::string& userPart = "") const;                    ///< by its IPv4 address
  std::filesystem::path authorities() const { return directory_ / "ca.pem"; } ///< of an encrypted one

  void kill();    ///< at once: as after a crash
  void start();   ///< again, on the same port
  void suspend(); ///< connections are taken, and nothing is answered
  void resume();

 private:
  struct WithTls {
    std::string name;
  };
  RedisServer(std::vector<std::string> arguments, std::optional<WithTls> tls);

  std::filesystem::path directory_;
  std::vector<std::string> arguments_;
  bool isEncrypted_ = false;
  std::uint16_t port_ = 0;
  pid_t process_ = -1;
};

/// A port of 127.0.0.1 on which nobody listens now.
std::uint16_t freePort();

} // namespace gnomon::testing
