#include <algorithm>
#include <unordered_set>

#include "protocol/base/json.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/json/json_source.h"
#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxQueryKeys = 256; ///< more than a spec with a few lights has fields

using Query = std::vector<std::pair<std::string, std::string>>;

/// The path of a query key in the spec's JSON.
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

/// "AZIMUTH,ELEVATION" or "LATITUDE,LONGITUDE TIME" as the one light of the spec.
std::optional<JsonNode> sunOf(const std::string& text, ProblemList& problems) {
  const std::size_t space = text.find(' ');
  const bool byTime = space != std::string::npos;
  const std::vector<std::string> angles = split(text.substr(0, space), ',');
  if (angles.size() != 2) {
    problems.add(invalidValue("", "sun is two numbers with a comma between them.",
                              "AZIMUTH,ELEVATION in degrees, or LATITUDE,LONGITUDE in degrees, a space, and a time",
                              shortened(asUtf8(text), 60)));
    return std::nullopt;
  }
  std::optional<JsonNode> first = valueOf(angles[0], problems);
  std::optional<JsonNode> second = valueOf(angles[1], problems);
  if (!first || !second) return std::nullopt;
  JsonNode sun = objectOf(byTime ? "latitudeDegrees" : "azimuthDegrees", std::move(*first));
  auto& fields = std::get<JsonNode::Object>(sun.value);
  fields.push_back({byTime ? "longitudeDegrees" : "elevationDegrees", std::move(*second)});
  if (byTime) fields.push_back({"time", JsonNode{asUtf8(text.substr(space + 1))}});
  JsonNode lights{JsonNode::Array{}};
  std::get<JsonNode::Array>(lights.value).push_back(objectOf("sun", std::move(sun)));
  return lights;
}

bool isIndex(const FieldStep& step) {
  return std::holds_alternative<std::size_t>(step);
}

/// One step down the tree: what was there already, or what was made; nothing where no such step can be taken.
struct Descent {
  JsonNode* node = nullptr;
  bool isNew = false;
  bool leavesGap = false; ///< the list has no element before this one
};

Descent descend(JsonNode& from, const FieldStep& step) {
  if (auto* array = std::get_if<JsonNode::Array>(&from.value); array && isIndex(step)) {
    const std::size_t index = std::get<std::size_t>(step);
    if (index > array->size()) return {nullptr, false, true};
    const bool isNew = index == array->size();
    if (isNew) array->push_back({nullptr});
    return {&(*array)[index], isNew};
  }
  auto* object = std::get_if<JsonNode::Object>(&from.value);
  if (!object) return {};
  const std::string key = isIndex(step) ? std::to_string(std::get<std::size_t>(step)) : std::get<std::string>(step);
  const auto found =
      std::find_if(object->begin(), object->end(), [&](const JsonMember& member) { return member.key == key; });
  if (found != object->end()) return {&found->value, false};
  object->push_back({key, {nullptr}});
  return {&object->back().value, true};
}

/// Where `path` ends in the tree, its objects and lists made on the way; nothing where another key gave a value there
/// already, or no element comes before one in a list.
Descent makePlace(JsonNode& root, const std::vector<FieldStep>& path) {
  Descent place{&root, false};
  for (std::size_t i = 0; i < path.size(); ++i) {
    place = descend(*place.node, path[i]);
    const bool isLast = i + 1 == path.size();
    if (!place.node || (isLast && !place.isNew)) return {nullptr, false, place.leavesGap};
    if (isLast || !place.isNew) continue;
    place.node->value = isIndex(path[i + 1]) ? JsonNode{JsonNode::Array{}}.value : JsonNode{JsonNode::Object{}}.value;
  }
  return place;
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
    if (value) gather(key, std::move(*value));
  }

  /// To be called once all keys are read. Elements of lists come last and in their order, whichever way they came.
  void put() {
    std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      const bool ofList = std::any_of(a.path.begin(), a.path.end(), isIndex);
      const bool otherOfList = std::any_of(b.path.begin(), b.path.end(), isIndex);
      return ofList != otherOfList ? otherOfList : ofList && a.path < b.path;
    });
    for (Entry& entry : entries_) put(entry);
  }

  JsonNode& root() { return root_; }
  const std::vector<QueryField>& fields() const { return fields_; }

  static std::string shortenedKey(const std::string& key) { return shortened(key, 100); }

 private:
  void add(const std::string& key, ProblemCode code, const std::string& detail) {
    problems_.add({.code = code, .pointer = shortenedKey(key), .detail = detail});
  }

  struct Entry {
    std::string key;
    std::vector<FieldStep> path;
    JsonNode value;
  };

  void gather(const std::string& key, JsonNode value) {
    if (key == "view") {
      JsonNode list{JsonNode::Array{}};
      std::get<JsonNode::Array>(list.value).push_back(std::move(value));
      value = std::move(list);
    }
    const auto path = fieldSteps(key == "sun"      ? "lights"
                                 : key == "view"   ? "views"
                                 : key == "format" ? "output.format"
                                                   : key);
    if (path) return entries_.push_back({key, *path, std::move(value)});
    for (Problem problem : path.problems()) {
      problem.pointer = shortenedKey(key);
      problems_.add(std::move(problem));
    }
  }

  void put(Entry& entry) {
    const auto& [key, path, value] = entry;
    if (path.size() > static_cast<std::size_t>(kLimits.maxJsonDepth)) {
      return add(key, ProblemCode::malformed, "This path has too many parts.");
    }
    const Descent place = makePlace(root_, path);
    if (!place.node) {
      return add(key, ProblemCode::invalidValue,
                 place.leavesGap ? "The list has no element before this one: indices begin at 0 and leave none out."
                                 : "Another key of the query gives this field, too.");
    }
    *place.node = std::move(entry.value);
    fields_.push_back({key, pointerOf(path)});
  }

  ProblemList& problems_;
  JsonNode root_{JsonNode::Object{}};
  std::unordered_set<std::string> seen_;
  std::vector<Entry> entries_;
  std::vector<QueryField> fields_;
};

/// The query key that gave the value at a JSON pointer; where none did, the one that would.
std::string keyAt(const std::string& pointer, const std::vector<QueryField>& fields) {
  for (const QueryField& field : fields) {
    if (pointsInto(pointer, field.pointer)) return QueryReader::shortenedKey(field.key);
  }
  for (const QueryField& field : fields) {
    if (pointsInto(field.pointer, pointer)) return QueryReader::shortenedKey(field.key);
  }
  return fieldPath(pointer);
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
  reader.put();

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
