#pragma once

#include <string>
#include <string_view>

#include "server/http/http_reply.h"

namespace gnomon {

std::string_view reasonPhrase(int status);

/// Status line and headers, with the closing empty line. Safety headers stand there unless the reply brings its own:
/// Content-Security-Policy default-src 'none' and X-Content-Type-Options nosniff.
std::string replyHead(const HttpReply& reply, std::string_view requestId, bool keepAlive);

} // namespace gnomon
