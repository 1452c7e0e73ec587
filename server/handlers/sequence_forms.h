#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "server/handlers/sequence_frame.h"
#include "server/http/router.h"

namespace gnomon {

/// What sequences and jobs are sent as: the first is the choice without an Accept header.
inline constexpr std::array<std::string_view, 3> kSequenceForms{"multipart/mixed", "application/zip", kEventStream};

/// How a sequence is written. Functions that return bool send; false = the client is gone.
class SequenceForm {
 public:
  virtual ~SequenceForm() = default;
  virtual bool begin(const BodySink&) { return true; }
  virtual bool waiting(const BodySink&) { return true; }     ///< nothing came for some seconds
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

} // namespace gnomon
