#include "server/frames/etag.h"

#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/http/ascii.h"
#include "server/scenes/sha256.h"

namespace gnomon {
namespace {

std::string_view withoutWeakness(std::string_view tag) {
  return tag.starts_with("W/") ? tag.substr(2) : tag;
}

} // namespace

std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form) {
  Sha256 hash;
  for (const std::string_view part : {sceneId, std::string_view("\n"), fingerprint, std::string_view("\n"),
                                      mediaTypeOf(form), std::string_view("\n"), mediaTypeOf(form.format)}) {
    hash.add(part);
  }
  hash.add("\n");
  hash.add(toJson(spec).dump(-1, ' ', false, Json::error_handler_t::replace));
  const std::string tag = '"' + hash.hex() + '"';
  return form.form == ReplyForm::image ? tag : "W/" + tag;
}

bool etagMatches(std::string_view ifNoneMatch, std::string_view etag) {
  if (trimmed(ifNoneMatch) == "*") {
    return true;
  }
  for (const std::string& listed : split(ifNoneMatch, ',')) { // our tags hold no comma
    if (withoutWeakness(listed) == withoutWeakness(etag)) {
      return true;
    }
  }
  return false;
}

} // namespace gnomon
