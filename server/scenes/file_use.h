#pragma once

#include <chrono>
#include <string>

#include "server/system/file_descriptor.h"

/// Files that several processes use and remove: a file's time of change says when it was used last, and a lock on it
/// (flock) that it is in use.
namespace gnomon {

/// Opens a file for reading, holds a shared lock on it until every copy of the descriptor is closed, and marks it as
/// used now, unless its mark is younger than `resolution`. Empty, with errno, where there is none.
FileDescriptor openUsed(const std::string& path, std::chrono::milliseconds resolution);

/// Removes a file that has not been used for so long and is not in use. False where it stays.
bool removeIfUnused(const std::string& path, std::chrono::seconds age);

} // namespace gnomon
