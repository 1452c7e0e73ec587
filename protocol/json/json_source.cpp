#include "protocol/json/json_source.h"

#include <nlohmann/json.hpp>
#include <unordered_set>

#include "protocol/base/json.h"
#include "protocol/base/text.h"
#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxShownBytes = 60;

/// The parser's words without its tag and without the bytes that it read last.
std::string plainMessage(const std::string& what) {
  std::size_t begin = what.find("] ");
  begin = begin == std::string::npos ? 0 : begin + 2;
  return shortened(asUtf8(what.substr(begin, what.find("; last read") - begin)), 200);
}

/// Builds the tree and always knows where it is.
class TreeBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit TreeBuilder(ProblemList& problems) : problems_(problems) {}

  JsonNode takeRoot() && { return std::move(root_); }

  /// Of the value that is being read, or is next.
  std::string pointer() const {
    std::string result;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const Container& container = open_[i];
      if (const auto* array = std::get_if<JsonNode::Array>(&container.node->value)) {
        const bool holdsOpenChild = i + 1 < open_.size();
        result += "/" + std::to_string(array->size() - (holdsOpenChild ? 1 : 0));
      } else if (container.keyIsOpen) {
        result += pointerSegment(container.key);
      }
    }
    return result;
  }

  bool null() override { return add({nullptr}); }
  bool boolean(bool value) override { return add({value}); }
  bool number_integer(number_integer_t value) override { return add({std::int64_t{value}}); }
  bool number_unsigned(number_unsigned_t value) override { return add({std::uint64_t{value}}); }
  bool number_float(number_float_t value, const string_t& text) override { return add({JsonReal{value, text}}); }
  bool string(string_t& value) override { return add({std::move(value)}); }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open({JsonNode::Object{}}); }
  bool start_array(std::size_t) override { return open({JsonNode::Array{}}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Container& object = open_.back();
    object.key = key;
    object.keyIsOpen = true;
    if (!object.keys.insert(key).second) {
      problems_.add(invalidValue(pointer(), "This key appears more than once in its object."));
    }
    return true;
  }

  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) {
      problems_.add(invalidValue(pointer(), "This number is too large.", "a finite 64-bit floating-point number",
                                 shortened(asUtf8(token), kMaxShownBytes)));
    } else {
      problems_.add({.code = ProblemCode::malformed,
                     .pointer = pointer(),
                     .detail = "This is not JSON: " + plainMessage(error.what()) + "."});
    }
    return false;
  }

 private:
  struct Container {
    JsonNode* node = nullptr; ///< stays in place: its parent grows only after it is closed
    std::string key;          ///< of the member that is being read
    bool keyIsOpen = false;
    std::unordered_set<std::string> keys;
  };

  JsonNode& place(JsonNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return root_;
    }
    Container& parent = open_.back();
    if (auto* array = std::get_if<JsonNode::Array>(&parent.node->value)) {
      return array->emplace_back(std::move(node));
    }
    return std::get<JsonNode::Object>(parent.node->value).emplace_back(JsonMember{parent.key, std::move(node)}).value;
  }

  bool add(JsonNode node) {
    place(std::move(node));
    if (!open_.empty()) open_.back().keyIsOpen = false;
    return true;
  }

  bool open(JsonNode node) {
    JsonNode& placed = place(std::move(node));
    open_.emplace_back().node = &placed;
    return true;
  }

  bool close() {
    open_.pop_back();
    if (!open_.empty()) open_.back().keyIsOpen = false;
    return true;
  }

  ProblemList& problems_;
  JsonNode root_;
  std::vector<Container> open_;
};

/// The pointer of the value that would begin at the end of `prefix`, whose nesting is bounded.
std::string pointerAtEnd(std::string_view prefix) {
  ProblemList ignored;
  TreeBuilder builder(ignored);
  nlohmann::json::sax_parse(prefix.begin(), prefix.end(), &builder);
  return builder.pointer();
}

} // namespace

std::optional<JsonNode> readJson(std::string_view text, ProblemList& problems) {
  if (text.size() > kLimits.maxSpecBytes) {
    problems.add({.code = ProblemCode::tooLarge,
                  .detail = "The JSON is too long.",
                  .limit = std::to_string(kLimits.maxSpecBytes) + " bytes",
                  .actual = std::to_string(text.size()) + " bytes"});
    return std::nullopt;
  }
  if (const auto excess = findExcess(text, {kLimits.maxJsonDepth})) {
    problems.add({.code = ProblemCode::malformed,
                  .pointer = pointerAtEnd(text.substr(0, excess->offset)),
                  .detail = "Objects and arrays are nested too deeply.",
                  .limit = std::to_string(kLimits.maxJsonDepth) + " levels"});
    return std::nullopt;
  }
  // The parser takes a zero byte for the end of the text.
  if (const std::size_t offset = text.find('\0'); offset != std::string_view::npos) {
    problems.add({.code = ProblemCode::malformed,
                  .pointer = pointerAtEnd(text.substr(0, offset)),
                  .detail = "This is not JSON: there is a zero byte at offset " + std::to_string(offset) + "."});
    return std::nullopt;
  }
  TreeBuilder builder(problems);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
  return std::move(builder).takeRoot();
}

Json jsonOf(const JsonNode& node) {
  struct Converted {
    Json operator()(std::nullptr_t) const { return nullptr; }
    Json operator()(bool value) const { return value; }
    Json operator()(std::int64_t value) const { return value; }
    Json operator()(std::uint64_t value) const { return value; }
    Json operator()(const JsonReal& real) const { return real.value; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(const JsonNode::Array& array) const {
      Json json = Json::array();
      for (const JsonNode& element : array) json.push_back(jsonOf(element));
      return json;
    }
    Json operator()(const JsonNode::Object& object) const {
      Json json = Json::object();
      for (const JsonMember& member : object) json[member.key] = jsonOf(member.value);
      return json;
    }
  };
  return std::visit(Converted{}, node.value);
}

JsonNode nodeOf(const Json& json) {
  if (json.is_boolean()) return {json.get<bool>()};
  if (json.is_number_unsigned()) return {json.get<std::uint64_t>()};
  if (json.is_number_integer()) return {json.get<std::int64_t>()};
  if (json.is_number()) return {JsonReal{json.get<double>(), json.dump()}};
  if (json.is_string()) return {json.get<std::string>()};
  if (json.is_array()) {
    JsonNode::Array array;
    for (const Json& element : json) array.push_back(nodeOf(element));
    return {std::move(array)};
  }
  if (!json.is_object()) return {nullptr};
  JsonNode::Object object;
  for (const auto& [key, value] : json.items()) object.push_back({key, nodeOf(value)});
  return {std::move(object)};
}

std::string shownNode(const JsonNode& node) {
  struct Shown {
    std::string operator()(std::nullptr_t) const { return "null"; }
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(std::uint64_t value) const { return std::to_string(value); }
    std::string operator()(const JsonReal& real) const { return shortened(real.text, kMaxShownBytes); }
    std::string operator()(const std::string& text) const { return '"' + shortened(text, kMaxShownBytes) + '"'; }
    std::string operator()(const JsonNode::Array& array) const { return "an array of " + std::to_string(array.size()); }
    std::string operator()(const JsonNode::Object& object) const {
      return "an object of " + std::to_string(object.size());
    }
  };
  return std::visit(Shown{}, node.value);
}

} // namespace gnomon
