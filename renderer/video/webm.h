#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// WebM (Matroska of RFC 9559 with one VP9 track) that is sent while it is made: the head, then each frame, then a tag.
/// Nothing is written that only the end knows but the size of the segment, which stays open, as in live streams. Each
/// frame is a cluster of its own, so that a reader knows where it ends. libwebm's muxer could do this, too, but
/// Debian installs the header of its parser alone.
namespace gnomon {

/// The one track.
struct VideoTrack {
  int width = 0;               ///< pixels
  int height = 0;              ///< pixels
  double framesPerSecond = 30; ///< > 0
  int frames = 0;              ///< all of them: they give the duration
};

/// The bytes before the first frame. Colors: sRGB by BT.709's matrix, as encodeI420 gives them.
std::string webmHead(const VideoTrack& track);

/// Frame `index`, from 0. `isKey`: nothing before it is needed to decode it.
std::string webmFrame(const VideoTrack& track, int index, std::string_view vp9, bool isKey);

/// The bytes after the last frame: a named text about the whole file.
std::string webmTag(std::string_view name, std::string_view text);

} // namespace gnomon
