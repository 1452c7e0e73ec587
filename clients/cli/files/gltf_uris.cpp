#include "clients/cli/files/gltf_uris.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

/// The JSON text: of a GLB its first chunk, else the bytes themselves.
std::string_view jsonText(std::span<const std::uint8_t> model) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  const std::string_view text = asText(model);
  if (!text.starts_with("glTF")) return text;
  if (model.size() < kHeader + kChunkHeader) return {};
  const std::uint64_t length = littleEndian(model.subspan(kHeader, 4));
  if (length > model.size() - kHeader - kChunkHeader) return {};
  return text.substr(kHeader + kChunkHeader, length);
}

/// Follows the JSON event by event and keeps the strings at /buffers/N/uri and /images/N/uri.
class UriCollector : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::vector<std::string> uris;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= kLimits.maxJsonDepth; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ <= kLimits.maxJsonDepth; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  bool key(string_t& name) override {
    if (depth_ == 1) inList_ = name == "buffers" || name == "images";
    isUri_ = inList_ && depth_ == 3 && name == "uri";
    return true;
  }

  bool string(string_t& value) override {
    const bool wanted = isUri_ && depth_ == 3 && !value.starts_with("data:");
    if (wanted && std::find(uris.begin(), uris.end(), value) == uris.end()) uris.push_back(std::move(value));
    return true;
  }

 private:
  int depth_ = 0;       // 1 = inside the root object, 3 = inside an element of a list
  bool inList_ = false; // under /buffers or /images
  bool isUri_ = false;  // the last key was an element's uri
};

} // namespace

std::vector<std::string> externalUris(std::span<const std::uint8_t> model) {
  UriCollector collector;
  const std::string_view text = jsonText(model);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &collector)) return {};
  return std::move(collector.uris);
}

} // namespace gnomon::cli
