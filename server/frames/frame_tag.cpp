#include "server/frames/frame_tag.h"

#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form) {
  Sha256 hash;
  for (const std::string_view part : {sceneId, std::string_view("\n"), fingerprint, std::string_view("\n"),
                                      mediaTypeOf(form), std::string_view("\n"), mediaTypeOf(form.format)}) {
    hash.add(part);
  }
  hash.add("\n");
  hash.add(jsonText(toJson(spec)));
  const std::string tag = '"' + hash.hex() + '"';
  return tellsTimes(form) ? "W/" + tag : tag;
}

std::string reprDigest(std::string_view body) {
  Sha256 hash;
  hash.add(body);
  return "sha-256=:" + base64Text(hash.bytes()) + ':';
}

} // namespace gnomon
