#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::cli {

/// Waits for files to change. Their folders are watched, so that a file that is replaced by renaming another over it,
/// as editors do, is a change as well as one that is written to. SIGINT and SIGTERM end the wait; from its creation on
/// they do nothing else in this process.
class FileWatch {
 public:
  static Result<FileWatch> create();
  FileWatch(FileWatch&& other) noexcept;
  FileWatch& operator=(FileWatch&&) = delete;
  ~FileWatch();

  /// The files to watch from now on, instead of those before. Folders that are watched already go on being so: no
  /// change is missed in between.
  Status watch(const std::vector<std::filesystem::path>& files);

  /// Until a file has changed and then none has for a moment. False: a signal came.
  bool wait();

 private:
  FileWatch(int events, int signals) : events_(events), signals_(signals) {}
  enum class Wake { file, signal, nothing };
  Wake next(int milliseconds); ///< -1 = without end
  bool readEvents();

  int events_;                                  ///< of inotify
  int signals_;                                 ///< of signalfd
  std::map<std::string, int> folders_;          ///< to their number at inotify
  std::set<std::pair<int, std::string>> names_; ///< folder and name of each file
};

} // namespace gnomon::cli
