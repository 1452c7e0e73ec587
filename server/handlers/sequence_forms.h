#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/base/zip.h"
#include "server/handlers/sequence_frames.h"
#include "server/http/router.h"

namespace gnomon {

/// A ZIP that is sent while it is made: each file's bytes follow its head at once, stored as they are, and only the
/// directory, some hundred bytes a file, is kept for the end. Larger than 4 GB and with more than 65,535 files as
/// ZIP64.
class ZipStream {
 public:
  /// What is sent before the bytes of a file. REQUIRES: `name` is ASCII.
  std::string head(std::string_view name, std::uint32_t size, std::uint32_t crc32) {
    const ZipFile file{.name = name, .crc32 = crc32, .bytes = size, .packedBytes = size};
    std::string text = zipHead(file);
    directory_ += zipDirectoryEntry(file, offset_);
    ++files_;
    offset_ += text.size() + size;
    return text;
  }

  /// What is sent after the last file.
  std::string end() const { return directory_ + zipEnd(files_, directory_.size(), offset_); }

 private:
  std::string directory_;
  std::uint64_t files_ = 0;
  std::uint64_t offset_ = 0; ///< of what comes next
};

/// What sequences and jobs are sent as: the first is the choice without an Accept header.
inline constexpr std::array<std::string_view, 3> kSequenceForms{"multipart/mixed", "application/zip", kEventStream};

/// How a sequence is written. Functions that return bool send; false = the client is gone.
class SequenceForm {
 public:
  virtual ~SequenceForm() = default;
  virtual bool begin(const BodySink&) { return true; }
  virtual std::string_view heartbeat() const { return {}; }  ///< sent where nothing came for some seconds
  virtual Status encode(const DoneFrame&) { return Done{}; } ///< before it is sent; a problem ends the sequence
  virtual bool frame(const BodySink& sink, const DoneFrame& frame, int of) = 0;
  virtual bool report(const BodySink& sink, std::string_view json) = 0;
  virtual bool problem(const BodySink& sink, std::string_view json) = 0;
};

struct TypedForm {
  std::string contentType; ///< the whole header value
  std::shared_ptr<SequenceForm> form;
};

/// `mediaType`: one of kSequenceForms.
TypedForm sequenceForm(std::string_view mediaType, const RouteCall& call);

/// The pictures of one frame: a picture as itself, several as multipart/mixed, each with its view.
HttpReply frameReply(const DoneFrame& frame, const RouteCall& call);

/// A reply that sends the frames while they are drawn, and at last the report or a problem. `first`: a frame that was
/// waited for. `report`: what it begins with.
HttpReply sequenceReply(TypedForm form, const RouteCall& call, std::shared_ptr<FrameSource> frames,
                        std::optional<DoneFrame> first, SequenceReport report);

} // namespace gnomon
