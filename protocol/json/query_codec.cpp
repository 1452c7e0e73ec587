#include "protocol/json/query_codec.h"

#include <algorithm>
#include <unordered_set>

#include "protocol/base/json.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/json_source.h"
#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxQueryKeys = 256; ///< more than a spec without lists has fields

using Query = std::vector<std::pair<std::string, std::string>>;

/// What a query key stands for: a path in the spec's JSON.
struct QueryField {
  std::string key;     ///< as it was written
  std::string pointer; ///< of the JSON value that it gives
};

JsonNode objectOf(std::string key, JsonNode value) {
  JsonNode node{JsonNode::Object{}};
  std::get<JsonNode::Object>(node.value).push_back({std::move(key), std::move(value)});
  return node;
}

/// JSON where the value begins like JSON or is one of its words, and a string otherwise.
std::optional<JsonNode> valueOf(const std::string& text, ProblemList& problems) {
  const bool isJson = text == "true" || text == "false" || text == "null" ||
                      (!text.empty() && std::string_view("{[\"-0123456789").find(text[0]) != std::string_view::npos);
  if (isJson) return readJson(text, problems);
  if (isUtf8(text)) return JsonNode{text};
  problems.add({.code = ProblemCode::malformed, .detail = "This text is not UTF-8.", .limit = "UTF-8"});
  return std::nullopt;
}

/// "AZIMUTH,ELEVATION" as the one light of the spec.
std::optional<JsonNode> sunOf(const std::string& text, ProblemList& problems) {
  const std::vector<std::string> angles = split(text, ',');
  if (angles.size() != 2) {
    problems.add({.code = ProblemCode::invalidValue,
                  .detail = "sun is two numbers with a comma between them.",
                  .limit = "AZIMUTH,ELEVATION in degrees",
                  .actual = shortened(asUtf8(text), 60)});
    return std::nullopt;
  }
  std::optional<JsonNode> azimuth = valueOf(angles[0], problems);
  std::optional<JsonNode> elevation = valueOf(angles[1], problems);
  if (!azimuth || !elevation) return std::nullopt;
  JsonNode sun = objectOf("azimuthDegrees", std::move(*azimuth));
  std::get<JsonNode::Object>(sun.value).push_back({"elevationDegrees", std::move(*elevation)});
  JsonNode lights{JsonNode::Array{}};
  std::get<JsonNode::Array>(lights.value).push_back(objectOf("sun", std::move(sun)));
  return lights;
}

/// Where `path` ends in the tree, its objects made on the way; nothing where another key gave a value there already.
JsonNode* makePlace(JsonNode& root, const std::vector<std::string>& path) {
  JsonNode* node = &root;
  for (std::size_t i = 0; i < path.size(); ++i) {
    auto* object = std::get_if<JsonNode::Object>(&node->value);
    if (!object) return nullptr;
    const auto found =
        std::find_if(object->begin(), object->end(), [&](const JsonMember& member) { return member.key == path[i]; });
    const bool isLast = i + 1 == path.size();
    if (found != object->end()) {
      if (isLast) return nullptr;
      node = &found->value;
    } else {
      object->push_back({path[i], isLast ? JsonNode{nullptr} : JsonNode{JsonNode::Object{}}});
      node = &object->back().value;
    }
  }
  return node;
}

/// Reads a query into the tree of the same spec's JSON.
class QueryReader {
 public:
  explicit QueryReader(ProblemList& problems) : problems_(problems) {}

  void read(const std::string& key, const std::string& text) {
    if (!isUtf8(key)) return add(asUtf8(key), ProblemCode::malformed, "This key is not UTF-8.");
    if (!seen_.insert(key).second) return add(key, ProblemCode::invalidValue, "This key is given more than once.");
    ProblemList inValue;
    std::optional<JsonNode> value = key == "sun" ? sunOf(text, inValue) : valueOf(text, inValue);
    for (Problem problem : inValue.problems()) {
      problem.pointer = shortenedKey(key);
      problems_.add(std::move(problem));
    }
    if (value) put(key, std::move(*value));
  }

  JsonNode& root() { return root_; }
  const std::vector<QueryField>& fields() const { return fields_; }

  static std::string shortenedKey(const std::string& key) { return shortened(key, 100); }

 private:
  void add(const std::string& key, ProblemCode code, const std::string& detail) {
    problems_.add({.code = code, .pointer = shortenedKey(key), .detail = detail});
  }

  void put(const std::string& key, JsonNode value) {
    std::vector<std::string> path;
    if (key == "sun") {
      path = {"lights"};
    } else if (key == "view") {
      path = {"views"};
      JsonNode list{JsonNode::Array{}};
      std::get<JsonNode::Array>(list.value).push_back(std::move(value));
      value = std::move(list);
    } else if (key == "format") {
      path = {"output", "format"};
    } else {
      path = split(key, '.');
    }
    if (path.size() > static_cast<std::size_t>(kLimits.maxJsonDepth)) {
      return add(key, ProblemCode::malformed, "This path has too many parts.");
    }
    JsonNode* place = makePlace(root_, path);
    if (!place) return add(key, ProblemCode::invalidValue, "Another key of the query gives this field, too.");
    *place = std::move(value);
    std::string pointer;
    for (const std::string& part : path) pointer += pointerSegment(part);
    fields_.push_back({key, std::move(pointer)});
  }

  ProblemList& problems_;
  JsonNode root_{JsonNode::Object{}};
  std::unordered_set<std::string> seen_;
  std::vector<QueryField> fields_;
};

/// The query key that gave what stands at a JSON pointer; where none did, the one that would: its dotted path.
std::string keyAt(const std::string& pointer, const std::vector<QueryField>& fields) {
  for (const QueryField& field : fields) {
    if (pointsInto(pointer, field.pointer)) return QueryReader::shortenedKey(field.key);
  }
  for (const QueryField& field : fields) {
    if (pointsInto(field.pointer, pointer)) return QueryReader::shortenedKey(field.key);
  }
  std::string path = pointer.empty() ? "" : pointer.substr(1);
  std::replace(path.begin(), path.end(), '/', '.');
  return path;
}

} // namespace

Result<FrameSpec> decodeFrameQuery(const Query& query) {
  if (query.size() > kMaxQueryKeys) {
    return Problem{.code = ProblemCode::tooLarge,
                   .detail = "The query has too many keys.",
                   .limit = std::to_string(kMaxQueryKeys),
                   .actual = std::to_string(query.size())};
  }
  ProblemList problems;
  QueryReader reader(problems);
  for (const auto& [key, text] : query) reader.read(key, text);

  Result<FrameSpec> spec = decodeFrameTree(reader.root(), ProblemList());
  if (!spec) {
    for (Problem problem : spec.problems()) {
      problem.pointer = keyAt(problem.pointer, reader.fields());
      problems.add(std::move(problem));
    }
  }
  if (problems.empty()) return spec;
  return std::move(problems).take();
}

} // namespace gnomon
