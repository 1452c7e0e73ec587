#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace gnomon::bench {

/// The program under test, and where it may run.
struct Program {
  std::filesystem::path file;      ///< gnomon
  std::string device;              ///< cpu, gl
  std::string instructionSet = {}; ///< GNOMON_CPU_TARGET; empty = the best one
  int cores = 0;                   ///< it may use the first so many; 0 = all
  int workers = 1;                 ///< of a server; 0 = as many as it starts by itself
};

/// One kept connection to a server. Whatever is refused throws, with what the server says.
class Connection {
 public:
  explicit Connection(const std::string& origin);
  ~Connection();

  nlohmann::json get(const std::string& path);
  /// The scene's id.
  std::string upload(const Bytes& glb);
  /// Asks for a frame as PNG: milliseconds until its last byte is here.
  double draw(const std::string& scene, const nlohmann::json& spec);

 private:
  struct Client;
  std::unique_ptr<Client> client_;
};

/// `gnomon serve` on a free port of the loopback, which draws every frame anew. Ends with this.
class Server {
 public:
  /// Waits until it is ready. Throws where the server ends first.
  explicit Server(const Program& program);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  const std::string& origin() const { return origin_; } ///< "http://127.0.0.1:PORT"
  double readyMilliseconds() const { return ready_; }   ///< from the process's start to the first 200 of /readyz
  double peakBytes() const;                             ///< most memory in use so far, by the server and its workers
  double processorMilliseconds() const;                 ///< of all their threads so far

 private:
  int process_ = 0;
  std::string origin_;
  double ready_ = 0;
};

/// Runs `gnomon render` with further arguments to its end, which must be a good one: milliseconds.
double renderMilliseconds(const Program& program, std::vector<std::string> arguments);

} // namespace gnomon::bench
