#include "protocol/sequence/sequence.h"

#include <algorithm>

#include "protocol/evaluation/evaluation.h"
#include "protocol/fields/field_codec.h"
#include "protocol/sequence/between_keys.h"
#include "protocol/spec/validate.h"

namespace gnomon {
namespace {

/// Where a frame lies between its keys. In whole numbers, so that it is exact at each of them.
struct KeyedPlace {
  std::size_t key = 0; ///< the one before it
  double t = 0;        ///< 0 = that one; below 1
};

KeyedPlace keyedPlace(const Sequence& sequence, int index) {
  const auto last = static_cast<std::size_t>(sequence.count - 1);
  const std::size_t along = static_cast<std::size_t>(index) * (sequence.patches.size() - 1);
  return {along / last, static_cast<double>(along % last) / static_cast<double>(last)};
}

Json patched(const Sequence& sequence, std::size_t patch) {
  Json merged = sequence.spec;
  merged.merge_patch(sequence.patches[patch]);
  return merged;
}

/// Frame `index` as it would have been written.
Json writtenFrame(const Sequence& sequence, int index) {
  if (!sequence.isKeyed) return patched(sequence, static_cast<std::size_t>(index));
  const KeyedPlace place = keyedPlace(sequence, index);
  Json before = patched(sequence, place.key);
  return place.t == 0 ? before : between(before, patched(sequence, place.key + 1), place.t);
}

constexpr const char* kTarget =
    "A target would choose other settings for each frame; ask for one frame with it, and take its settings.";

void checkCarried(const Carried& carried, const std::string& place, ProblemList& problems) {
  for (std::size_t i = 0; i < carried.depthRanges.size(); ++i) {
    const CarriedRange& range = carried.depthRanges[i];
    const std::string pointer = place + "/depthRanges/" + std::to_string(i);
    if (range.near >= range.far)
      problems.add(invalidValue(pointer + "/far", "The value of far must be more than near."));
    if (i > 0 && range.light <= carried.depthRanges[i - 1].light) {
      problems.add(invalidValue(pointer + "/light", "The lights must ascend, each once."));
    }
  }
}

/// What is wrong with the members beside the frames.
void checkMembers(const SequenceRequest& request, const Json& document, ProblemList& problems) {
  const bool given[] = {document.contains("frames"), document.contains("keys")};
  if (given[0] == given[1]) {
    problems.add(
        invalidValue("", "A sequence is of frames or of keys.", "frames | keys", given[0] ? "both" : "neither"));
  }
  if (given[1] && !document.contains("count")) problems.add(invalidValue("/count", "Keys need the number of frames."));
  if (given[0] && document.contains("count")) {
    problems.add(invalidValue("/count", "count goes with keys; a list of frames has its own length."));
  }
  if (request.spec.quality) problems.add(invalidValue("/spec/quality", kTarget));
  if (request.carried) checkCarried(*request.carried, "/carried", problems);
  if (request.carried && !request.stable) {
    problems.add(invalidValue("/carried", "Frames take nothing from each other where stable is false."));
  }
  if (request.first > 0 && request.stable && !request.carried) {
    problems.add(invalidValue("/carried",
                              "A stable sequence that goes on at a later frame needs what the frame before it "
                              "left."));
  }
}

/// Whether all frames can be checked in bounded time.
void checkSize(const Sequence& sequence, ProblemList& problems) {
  std::size_t longest = 0;
  std::size_t bytes = 0;
  for (const Json& patch : sequence.patches) {
    const std::size_t size = jsonText(patch).size();
    longest = std::max(longest, size);
    bytes += size;
  }
  const auto count = static_cast<std::size_t>(sequence.count);
  if (sequence.isKeyed) bytes = 2 * longest * count;
  bytes += jsonText(sequence.spec).size() * count * (sequence.isKeyed ? 2 : 1);
  if (bytes <= kLimits.maxSequenceSpecBytes) return;
  problems.add({.code = ProblemCode::tooLarge,
                .detail = "The specs of all frames are too large together: fewer frames, or a shorter spec.",
                .limit = std::to_string(kLimits.maxSequenceSpecBytes) + " bytes",
                .actual = std::to_string(bytes) + " bytes"});
}

void checkPatches(const Sequence& sequence, ProblemList& problems) {
  const std::string list = sequence.isKeyed ? "/keys/" : "/frames/";
  for (std::size_t i = 0; i < sequence.patches.size(); ++i) {
    ProblemList removals;
    checkRemovals(sequence.patches[i], removals);
    for (Problem& problem : within(std::move(removals).take(), list + std::to_string(i))) {
      problems.add(std::move(problem));
    }
  }
  for (std::size_t i = 1; sequence.isKeyed && i < sequence.patches.size(); ++i) {
    ProblemList differences;
    checkNeighbours(patched(sequence, i - 1), patched(sequence, i), Place(), differences);
    for (Problem& problem : within(std::move(differences).take(), list + std::to_string(i))) {
      problems.add(std::move(problem));
    }
  }
}

/// Reads every frame. Problems of the spec itself are already reported.
void checkFrames(const Sequence& sequence, const std::function<void(const FrameSpec&)>& each, ProblemList& problems) {
  const Problems known = problems.problems();
  for (int index = 0; index < sequence.count && problems.problems().size() < ProblemList::kMax; ++index) {
    const auto frame = decodeFrameTree(nodeOf(writtenFrame(sequence, index)), {});
    const std::string place = framePlace(sequence, index);
    if (!frame) {
      addPatchProblems(frame.problems(), known, place, problems);
    } else if (frame->quality) {
      if (!sequence.spec.contains("quality")) problems.add(invalidValue(place + "/quality", kTarget));
    } else if (index >= sequence.first && each) {
      each(*frame);
    }
  }
}

std::vector<Json> parsed(const std::vector<SpecPatch>& patches) {
  std::vector<Json> result;
  for (const SpecPatch& patch : patches) result.push_back(Json::parse(patch.json));
  return result;
}

} // namespace

Result<Sequence> decodeSequence(std::string_view json, const std::function<void(const FrameSpec&)>& each) {
  ProblemList problems;
  const std::optional<JsonNode> root = readJson(json, problems);
  if (!root) return std::move(problems).take();
  SequenceRequest request;
  decodeValue(*root, Notes{}, Place(), problems, request);
  const Json document = jsonOf(*root);
  if (!document.is_object()) return std::move(problems).take();
  checkSpecRules(request.spec, problems);
  checkMembers(request, document, problems);

  Sequence sequence{.isKeyed = request.keys.has_value(),
                    .stable = request.stable,
                    .framesPerSecond = request.framesPerSecond,
                    .videoQuality = request.videoQuality,
                    .first = request.first,
                    .carried = request.carried.value_or(Carried())};
  sequence.spec = writtenSpec(document);
  const bool isWhole = sequence.isKeyed ? !request.frames && request.count.has_value() : request.frames.has_value();
  if (!isWhole) {
    if (problems.empty()) problems.add(invalidValue("", "A sequence is of frames or of keys.", "frames | keys"));
    return std::move(problems).take();
  }
  sequence.patches = parsed(sequence.isKeyed ? *request.keys : *request.frames);
  sequence.count = sequence.isKeyed ? *request.count : static_cast<int>(sequence.patches.size());
  if (sequence.first >= sequence.count) {
    problems.add(invalidValue("/first", "There is no frame of this index.", "0.." + std::to_string(sequence.count - 1),
                              std::to_string(sequence.first)));
  }
  const std::size_t before = problems.problems().size();
  checkSize(sequence, problems);
  if (problems.problems().size() == before) checkPatches(sequence, problems);
  if (problems.problems().size() == before) checkFrames(sequence, each, problems);
  if (problems.empty()) return sequence;
  return std::move(problems).take();
}

FrameSpec frameSpec(const Sequence& sequence, int index, const Carried& before) {
  const Json written = writtenFrame(sequence, index);
  FrameSpec spec = *decodeFrameTree(nodeOf(written), {});
  if (sequence.stable) makeStable(spec, written, before);
  return spec;
}

std::string framePlace(const Sequence& sequence, int index) {
  if (!sequence.isKeyed) return "/frames/" + std::to_string(index);
  return "/keys/" + std::to_string(keyedPlace(sequence, index).key);
}

Result<Carried> decodeCarried(std::string_view json) {
  ProblemList problems;
  Carried carried;
  if (const std::optional<JsonNode> root = readJson(json, problems)) {
    decodeValue(*root, Notes{}, Place(), problems, carried);
    checkCarried(carried, "", problems);
  }
  if (problems.empty()) return carried;
  return std::move(problems).take();
}

} // namespace gnomon
