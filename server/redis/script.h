#pragma once

#include <string>
#include <string_view>

namespace gnomon::redis {

/// A Lua script that the server runs as one step. It is sent once, and named by its SHA-1 after that.
class Script {
 public:
  explicit Script(std::string_view text);

  const std::string& text() const { return text_; }
  const std::string& sha1() const { return sha1_; } ///< 40 lower-case digits

 private:
  std::string text_;
  std::string sha1_;
};

} // namespace gnomon::redis
