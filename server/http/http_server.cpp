#include "server/http/http_server.h"

#include <system_error>
#include <utility>

namespace gnomon {

std::string addressOf(const std::string& bind, int port) {
  const bool ipv6 = bind.find(':') != std::string::npos;
  return "http://" + (ipv6 ? "[" + bind + "]" : bind) + ":" + std::to_string(port);
}

Result<std::unique_ptr<HttpServer>> HttpServer::listen(const HttpServerOptions& options, ConnectionContext& context) {
  auto listener = Listener::open(options.bind, options.port);
  if (!listener) {
    return Problem{ProblemCode::unavailable, "",
                   "The server can't listen on this address. It is in use, or does not belong to this machine.", "",
                   options.bind + ":" + std::to_string(options.port)};
  }
  try {
    return std::unique_ptr<HttpServer>(new HttpServer(*std::move(listener), context, options));
  } catch (const std::system_error&) {
    return Problem{ProblemCode::unavailable, "", "The system does not allow this process so many threads.", "",
                   std::to_string(options.threads)};
  }
}

bool HttpServer::run() {
  const bool inOrder = listener_.run(
      context_.stop, [this](OpenConnection connection) { pending_.admit(std::move(connection)); },
      [this] { pending_.makeRoom(); });
  pending_.finish();
  return inOrder;
}

} // namespace gnomon
