#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/bytes.h"
#include "server/system/file_descriptor.h"

/// Files that appear whole or not at all.
namespace gnomon {

// Several processes use and remove these: a file's time of change says when it was used last, and a shared lock (flock)
// that it is in use.

/// Opens a regular file for reading, holds a shared lock on it until every copy of the descriptor is closed, and marks
/// it as used now, unless its mark is younger than `resolution`. Empty, with errno, where there is none.
FileDescriptor openUsed(const std::string& path, std::chrono::milliseconds resolution);

/// Whether a file has not been used for so long and is not in use.
bool isUnused(const std::string& path, std::chrono::seconds age);

/// Removes such a file. False where it stays.
bool removeIfUnused(const std::string& path, std::chrono::seconds age);

using FileSink = std::function<void(std::span<const std::uint8_t>)>;

/// Writes a file under another name, through to the disk, and renames it. `produce` is given what appends to it. False,
/// with errno, where the disk refuses.
bool placeFile(const std::string& path, const std::function<void(const FileSink&)>& produce);

/// All of a regular file of at most so many bytes; nothing where it can't be read.
std::optional<Bytes> readWhole(const std::string& path, std::size_t most = std::numeric_limits<std::size_t>::max());

/// Makes it lasting that files of this directory appeared or went. False, with errno, where the disk refuses.
bool syncDirectory(const std::string& path);

/// Removes what placeFile has left in a directory where its process died: files without a lock that were not
/// written to for a minute.
void removeUnfinished(const std::string& directory);

/// Calls with the name of each entry of a folder, in no order, `.` and `..` left out. What appears or goes meanwhile
/// may be among them or not. False, with errno, where the folder can't be read, or not to its end.
bool eachName(const std::string& folder, const std::function<void(std::string_view name)>& visit);

} // namespace gnomon
