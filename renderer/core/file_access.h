#pragma once

#include <span>
#include <string>

namespace gnomon {

enum class FileUse {
  read,        ///< folders are listed, too
  change,      ///< read and written, and controlled where it is a device; none is made or removed
  readAndStart ///< read, and started as a program
};

/// A file, or a folder with all that is in it.
struct FileGrant {
  std::string path;
  FileUse use = FileUse::read;
};

/// Leaves the calling thread, and all that it starts from now on, these files and no other, whatever the user may do
/// (landlock(7)); nor is a process outside looked into. Files that are open stay so; grants of what does not exist are
/// passed over. Call it after dropPrivileges, before other threads start. 0, or an error number: ENOSYS or EOPNOTSUPP
/// where the system has no Landlock, and nothing has changed.
int keepFiles(std::span<const FileGrant> grants);

} // namespace gnomon
