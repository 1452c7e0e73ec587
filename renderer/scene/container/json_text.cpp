#include "renderer/scene/container/json_text.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/json.h"

namespace gnomon {

namespace {

using nlohmann::json;

/// A long data: URI that a text no longer holds.
struct Cut {
  std::size_t string = 0;   ///< which of the text's strings it was, keys included
  std::size_t end = 0;      ///< in the shorter text: behind its closing quote
  std::string_view content; ///< between its quotes
};

/// JSON in which "" stands for each long data: URI, since a parser takes ten times as long for one as a copy does.
struct CutText {
  std::string text;
  std::vector<Cut> cuts; ///< in order
};

/// Whether each character of a string stands for itself, and is one that JSON allows.
bool isPlain(std::string_view text) {
  constexpr std::size_t kBlock = 64;
  const auto isOdd = [](char c) { return c < ' ' || c == '\\' || c == '\x7f'; }; // negative where not ASCII
  for (; text.size() >= kBlock; text.remove_prefix(kBlock)) {
    unsigned odd = 0;
    for (std::size_t i = 0; i < kBlock; ++i) odd |= static_cast<unsigned>(isOdd(text[i]));
    if (odd != 0) return false;
  }
  return std::none_of(text.begin(), text.end(), isOdd);
}

/// What stands before the closing quote, if that is a long data: URI; otherwise nothing.
std::string_view longDataUri(std::string_view text) {
  constexpr std::size_t kLong = 256;
  if (!text.starts_with("data:")) return {};
  const std::size_t length = text.find('"');
  if (length == std::string_view::npos || length < kLong) return {};
  const std::string_view content = text.substr(0, length);
  return isPlain(content) ? content : std::string_view();
}

/// Behind the closing quote of the string that begins at `at`, or at the end of the text.
std::size_t behindString(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

/// Up to where the text stops being JSON its strings are those that a parser finds; what is behind is of no account.
CutText withoutDataUris(std::string_view text) {
  CutText result;
  std::size_t kept = 0; // of the text, what is before it is in the result
  std::size_t string = 0;
  for (std::size_t at = text.find('"'); at != std::string_view::npos; at = text.find('"', at), ++string) {
    const std::string_view content = longDataUri(text.substr(at + 1));
    if (content.empty()) {
      at = behindString(text, at);
      continue;
    }
    result.text.append(text.substr(kept, at + 1 - kept)).append("\"");
    result.cuts.push_back({string, result.text.size(), content});
    kept = at + 1 + content.size() + 1;
    at = kept;
  }
  result.text.append(text.substr(kept));
  return result;
}

/// Makes values of what the parser finds, with what was cut in its place.
class JsonReader final : public nlohmann::json_sax<json> {
 public:
  explicit JsonReader(const std::vector<Cut>& cuts) : cuts_(cuts) {}

  bool null() override { return put(nullptr) != nullptr; }
  bool boolean(bool value) override { return put(value) != nullptr; }
  bool number_integer(std::int64_t value) override { return put(value) != nullptr; }
  bool number_unsigned(std::uint64_t value) override { return put(value) != nullptr; }
  bool number_float(double value, const std::string&) override { return put(value) != nullptr; }
  bool string(std::string& value) override {
    restore(value);
    return put(std::move(value)) != nullptr;
  }
  bool binary(json::binary_t&) override { return false; } // JSON has none
  bool start_object(std::size_t) override {
    open_.push_back(put(json::object()));
    return true;
  }
  bool key(std::string& name) override {
    restore(name);
    member_ = &(*open_.back())[name];
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override {
    open_.push_back(put(json::array()));
    return true;
  }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    isNoJson_ = dynamic_cast<const json::parse_error*>(&error) != nullptr;
    position_ = position;
    return false;
  }

  json take() { return std::move(root_); }

  Problem problem() const {
    if (!isNoJson_) {
      return {ProblemCode::malformed, {}, "The glTF's JSON holds a number that no double can hold."};
    }
    std::size_t byte = position_;
    for (const Cut& cut : cuts_) byte += cut.end <= position_ ? cut.content.size() : 0;
    return {ProblemCode::malformed, {}, "The glTF is not valid JSON: byte " + std::to_string(byte) + " is unexpected."};
  }

 private:
  void restore(std::string& text) {
    if (nextCut_ < cuts_.size() && cuts_[nextCut_].string == strings_) text = cuts_[nextCut_++].content;
    ++strings_;
  }

  json* put(json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    if (auto* array = open_.back()->get_ptr<json::array_t*>()) return &array->emplace_back(std::move(value));
    return &(*member_ = std::move(value));
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  const std::vector<Cut>& cuts_;
  std::size_t strings_ = 0; ///< that were read
  std::size_t nextCut_ = 0;
  json root_;
  std::vector<json*> open_; ///< objects and arrays, each within the one before
  json* member_ = nullptr;  ///< of the innermost object: where the next value goes
  bool isNoJson_ = false;
  std::size_t position_ = 0; ///< of an error in the shorter text
};

std::optional<Problem> checkShape(std::string_view text, const Limits& limits) {
  const auto excess = findExcess(text, {limits.maxJsonDepth, limits.maxJsonValues});
  if (!excess) return std::nullopt;
  if (excess->of == JsonExcess::Of::depth) {
    return Problem{ProblemCode::tooLarge,
                   {},
                   "The glTF's JSON is nested too deeply.",
                   std::to_string(limits.maxJsonDepth),
                   "more"};
  }
  return Problem{ProblemCode::tooLarge,
                 {},
                 "The glTF's JSON holds too many values.",
                 std::to_string(limits.maxJsonValues),
                 "more"};
}

} // namespace

Result<json> parseJsonText(std::string_view text, const Limits& limits) {
  const CutText cut = withoutDataUris(text);
  if (auto problem = checkShape(cut.text, limits)) return *std::move(problem);
  JsonReader reader(cut.cuts);
  if (!json::sax_parse(cut.text, &reader)) return reader.problem();
  json document = reader.take();
  if (!document.is_object()) {
    return Problem{ProblemCode::malformed, {}, "The glTF's JSON is not an object."};
  }
  return document;
}

} // namespace gnomon
