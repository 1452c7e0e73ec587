#include "tests/renderer/video/parsed_webm.h"

#include <webm/buffer_reader.h>
#include <webm/callback.h>
#include <webm/webm_parser.h>

namespace gnomon {
namespace {

using webm::ElementMetadata;
using webm::Status;

class Listener final : public webm::Callback {
 public:
  explicit Listener(ParsedWebm& parsed) : parsed_(parsed) {}

  Status OnEbml(const ElementMetadata&, const webm::Ebml& ebml) override {
    parsed_.ebml = ebml;
    return Status(Status::kOkCompleted);
  }
  Status OnInfo(const ElementMetadata&, const webm::Info& info) override {
    parsed_.info = info;
    return Status(Status::kOkCompleted);
  }
  Status OnTrackEntry(const ElementMetadata&, const webm::TrackEntry& track) override {
    parsed_.tracks.push_back(track);
    return Status(Status::kOkCompleted);
  }
  Status OnClusterBegin(const ElementMetadata&, const webm::Cluster& cluster, webm::Action* action) override {
    *action = webm::Action::kRead;
    time_ = cluster.timecode.value();
    return Status(Status::kOkCompleted);
  }
  Status OnSimpleBlockBegin(const ElementMetadata&, const webm::SimpleBlock& block, webm::Action* action) override {
    *action = webm::Action::kRead;
    parsed_.frames.push_back({time_ + static_cast<std::uint64_t>(block.timecode), block.is_key_frame, {}});
    return Status(Status::kOkCompleted);
  }
  Status OnFrame(const webm::FrameMetadata&, webm::Reader* reader, std::uint64_t* left) override {
    Bytes& bytes = parsed_.frames.back().bytes;
    while (*left > 0) {
      std::array<std::uint8_t, 4096> piece;
      std::uint64_t read = 0;
      const Status status = reader->Read(std::min<std::uint64_t>(*left, piece.size()), piece.data(), &read);
      bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(read));
      *left -= read;
      if (!status.completed_ok() && status.code != Status::kOkPartial) return status;
    }
    return Status(Status::kOkCompleted);
  }
  Status OnTag(const ElementMetadata&, const webm::Tag& tag) override {
    parsed_.tags.push_back(tag);
    return Status(Status::kOkCompleted);
  }

 private:
  ParsedWebm& parsed_;
  std::uint64_t time_ = 0; ///< of the cluster
};

} // namespace

ParsedWebm parsedWebm(std::string_view file) {
  ParsedWebm parsed;
  Listener listener(parsed);
  const std::span<const std::uint8_t> bytes = asBytes(file);
  webm::BufferReader reader(Bytes(bytes.begin(), bytes.end()));
  webm::WebmParser parser;
  parsed.isWhole = parser.Feed(&listener, &reader).completed_ok();
  return parsed;
}

} // namespace gnomon
