#include "server/redis/script.h"

#include <array>
#include <openssl/evp.h>
#include <span>

#include "protocol/base/bytes.h"

namespace gnomon::redis {

Script::Script(std::string_view text) : text_(text) {
  std::array<std::uint8_t, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_Digest(text_.data(), text_.size(), digest.data(), &size, EVP_sha1(), nullptr);
  sha1_ = hexText(std::span(digest).first(size));
}

} // namespace gnomon::redis
