#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon {

/// The bytes of a reply. Copies share them, so that what is kept or drawn once is sent to many clients from one place.
class ReplyBody {
 public:
  ReplyBody() = default;
  ReplyBody(std::string bytes) : bytes_(std::make_shared<const std::string>(std::move(bytes))) {}
  ReplyBody(std::string_view bytes) : ReplyBody(std::string(bytes)) {}
  ReplyBody(const char* text) : ReplyBody(std::string(text)) {}

  std::string_view view() const { return bytes_ ? std::string_view(*bytes_) : std::string_view(); }
  operator std::string_view() const { return view(); }
  std::size_t size() const { return view().size(); }
  bool empty() const { return view().empty(); }

  friend bool operator==(const ReplyBody& a, std::string_view b) { return a.view() == b; }

 private:
  std::shared_ptr<const std::string> bytes_;
};

} // namespace gnomon
