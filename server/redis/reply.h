#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct redisReader;

namespace gnomon::redis {

/// A command and its arguments, each any bytes: {"SET", key, value}.
using Command = std::vector<std::string>;

/// What a Redis server answers to one command.
struct Reply {
  enum class Kind { nil, integer, text, array, error };

  Kind kind = Kind::nil;
  std::int64_t integer = 0;      ///< of an integer
  std::string text{};            ///< of a text: its bytes, also "OK" and the like; of an error: its message
  std::vector<Reply> elements{}; ///< of an array

  bool isNil() const { return kind == Kind::nil; }
  bool isInteger() const { return kind == Kind::integer; }
  bool isText() const { return kind == Kind::text; }
  bool isArray() const { return kind == Kind::array; }
  bool isError() const { return kind == Kind::error; }
  bool isError(std::string_view word) const { return isError() && text.starts_with(word); } ///< as "NOSCRIPT"
};

/// How much the replies to a call may take together, on the wire and as elements of arrays. What exceeds it ends the
/// connection.
struct ReplyLimits {
  std::size_t bytes = 1 << 20;
  std::size_t elements = 16'384;
};

/// The command as it goes over the wire.
std::string wireText(const Command& command);

/// Replies from bytes that come in pieces. Holds no more than its limits, whatever comes.
class ReplyReader {
 public:
  ReplyReader();
  ReplyReader(const ReplyReader&) = delete;
  ReplyReader& operator=(const ReplyReader&) = delete;

  /// What the replies from now on may take. REQUIRES: nothing is left of earlier ones.
  void allow(const ReplyLimits& limits) { left_ = limits; }

  /// False where they exceed the limits, or are none of the protocol; nothing can be read any more then.
  bool feed(std::string_view bytes);

  /// The next reply; nothing while it is not whole.
  std::optional<Reply> next();

  bool isEmpty() const; ///< nothing of a further reply has come
  bool isBroken() const { return broken_; }

 private:
  ReplyLimits left_;
  std::unique_ptr<redisReader, void (*)(redisReader*)> reader_;
  bool broken_ = false;
};

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
