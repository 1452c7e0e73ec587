#include "server/redis/reply.h"

#include <array>
#include <hiredis/hiredis.h>
#include <new>
#include <openssl/evp.h>
#include <span>

#include "protocol/base/bytes.h"

namespace gnomon::redis {
namespace {

/// Where the reader wants its next value: in the array that it belongs to, or a root of its own. Called from C: what it
/// returns as nullptr ends the reading.
Reply* place(const redisReadTask* task, Reply&& value) noexcept {
  if (task->parent != nullptr) {
    Reply& element = static_cast<Reply*>(task->parent->obj)->elements[static_cast<std::size_t>(task->idx)];
    element = std::move(value);
    return &element;
  }
  return new (std::nothrow) Reply(std::move(value));
}

void* createText(const redisReadTask* task, char* bytes, std::size_t count) noexcept {
  try {
    const auto kind = task->type == REDIS_REPLY_ERROR ? Reply::Kind::error : Reply::Kind::text;
    return place(task, {.kind = kind, .text = std::string(bytes, count)});
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void* createArray(const redisReadTask* task, int elements) noexcept {
  auto& left = static_cast<ReplyLimits*>(task->privdata)->elements;
  const auto count = static_cast<std::size_t>(elements);
  if (elements < 0 || count > left) return nullptr;
  left -= count;
  try {
    return place(task, {.kind = Reply::Kind::array, .elements = std::vector<Reply>(count)});
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void* createInteger(const redisReadTask* task, long long value) noexcept {
  return place(task, {.kind = Reply::Kind::integer, .integer = value});
}

void* createNil(const redisReadTask* task) noexcept {
  return place(task, {});
}

void freeRoot(void* root) noexcept {
  delete static_cast<Reply*>(root);
}

redisReplyObjectFunctions functions{createText, createArray, createInteger, createNil, freeRoot};

} // namespace

std::string wireText(const Command& command) {
  std::vector<const char*> arguments;
  std::vector<std::size_t> sizes;
  for (const std::string& argument : command) {
    arguments.push_back(argument.data());
    sizes.push_back(argument.size());
  }
  sds text = nullptr;
  const int size = redisFormatSdsCommandArgv(&text, static_cast<int>(command.size()), arguments.data(), sizes.data());
  if (size < 0) throw std::bad_alloc();
  const std::unique_ptr<char, void (*)(sds)> owner(text, redisFreeSdsCommand);
  return {text, static_cast<std::size_t>(size)};
}

ReplyReader::ReplyReader() : reader_(redisReaderCreateWithFunctions(&functions), redisReaderFree) {
  if (!reader_) throw std::bad_alloc();
}

bool ReplyReader::feed(std::string_view bytes) {
  broken_ = broken_ || bytes.size() > left_.bytes;
  if (broken_) return false;
  left_.bytes -= bytes.size();
  reader_->privdata = &left_;
  broken_ = redisReaderFeed(reader_.get(), bytes.data(), bytes.size()) != REDIS_OK;
  return !broken_;
}

bool ReplyReader::isEmpty() const {
  constexpr int kUnknown = -1; // the type of a reply whose first byte has not come
  const bool isBetween = reader_->ridx == -1 || (reader_->ridx == 0 && reader_->rstack[0].type == kUnknown);
  return reader_->pos == reader_->len && isBetween;
}

std::optional<Reply> ReplyReader::next() {
  if (broken_) return std::nullopt;
  reader_->privdata = &left_;
  void* root = nullptr;
  broken_ = redisReaderGetReply(reader_.get(), &root) != REDIS_OK;
  const std::unique_ptr<Reply> reply(static_cast<Reply*>(root));
  return reply && !broken_ ? std::optional(std::move(*reply)) : std::nullopt;
}

Script::Script(std::string_view text) : text_(text) {
  std::array<std::uint8_t, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_Digest(text_.data(), text_.size(), digest.data(), &size, EVP_sha1(), nullptr);
  sha1_ = hexText(std::span(digest).first(size));
}

} // namespace gnomon::redis
