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
  return form.form == ReplyForm::image ? tag : "W/" + tag;
}

} // namespace gnomon
