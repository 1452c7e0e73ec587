#include "server/scenes/upload.h"

#include "server/http/router.h"

namespace gnomon {

Result<std::vector<FormPart>> partsOf(const HttpRequest& request, const Limits& limits) {
  const auto boundary = boundaryOf(headerValue(request.headers, "content-type").value_or(""));
  if (!boundary) {
    return Problem{ProblemCode::malformed, "", "The Content-Type names no boundary for the form.", "", ""};
  }
  constexpr std::size_t kModelAndSpec = 2;
  return parseMultipart(textOf(request.body), *boundary, limits.maxBundleFiles + kModelAndSpec);
}

Status checkBundleSize(const SceneBundle& bundle, const Limits& limits) {
  std::size_t bytes = bundle.model.size();
  for (const auto& [name, content] : bundle.files) {
    bytes += content.size();
  }
  if (bytes > limits.maxSceneBytes) {
    return Problem{ProblemCode::tooLarge, "", "The model and its files are too large.",
                   std::to_string(limits.maxSceneBytes) + " bytes", std::to_string(bytes) + " bytes"};
  }
  return Done{};
}

Result<SceneBundle> bundleFromRequest(HttpRequest& request, const Limits& limits) {
  SceneBundle bundle;
  if (mediaType(headerValue(request.headers, "content-type").value_or("")) == "multipart/form-data") {
    const auto parts = partsOf(request, limits);
    if (!parts) {
      return parts.problems();
    }
    auto made = bundleFromParts(*parts, {});
    if (!made) {
      return made;
    }
    bundle = *std::move(made);
    request.body = Bytes();
  } else {
    bundle.model = std::move(request.body);
  }
  if (bundle.model.empty()) {
    return Problem{ProblemCode::malformed, "", "The model is empty.", "", ""};
  }
  if (auto fits = checkBundleSize(bundle, limits); !fits) {
    return std::move(fits).problems();
  }
  return bundle;
}

} // namespace gnomon
