#include "renderer/core/file_access.h"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gnomon {
namespace {

// Of later versions than the system's headers.
constexpr std::uint64_t kTruncate = 1u << 14;
constexpr std::uint64_t kControl = 1u << 15;

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kOfFiles =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE | kTruncate | kControl;

/// Every right that this version of Landlock knows; it takes all that are named.
std::uint64_t rightsOf(int version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_MAKE_SYM | (LANDLOCK_ACCESS_FS_MAKE_SYM - 1);
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= 3) rights |= kTruncate;
  if (version >= 5) rights |= kControl;
  return rights;
}

std::uint64_t rightsOf(FileUse use) {
  switch (use) {
    case FileUse::change:
      return kRead | LANDLOCK_ACCESS_FS_WRITE_FILE | kControl;
    case FileUse::readAndStart:
      return kRead | LANDLOCK_ACCESS_FS_EXECUTE;
    default:
      return kRead;
  }
}

/// 0, or an error number.
int grant(int rules, const FileGrant& granted, std::uint64_t known) {
  const int file = ::open(granted.path.c_str(), O_PATH | O_CLOEXEC);
  if (file < 0) return 0;
  struct stat status {};
  landlock_path_beneath_attr rule{rightsOf(granted.use) & known, file};
  if (::fstat(file, &status) == 0 && !S_ISDIR(status.st_mode)) rule.allowed_access &= kOfFiles;
  const bool isAdded = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
  const int error = isAdded ? 0 : errno;
  ::close(file);
  return error;
}

} // namespace

int keepFiles(std::span<const FileGrant> grants) {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 0) return errno == EPERM ? ENOSYS : errno; // containers refuse calls that they do not know
  const std::uint64_t known = rightsOf(static_cast<int>(version));
  const landlock_ruleset_attr handled{known};
  const int rules = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
  if (rules < 0) return errno;
  int error = 0;
  for (const FileGrant& granted : grants) {
    if (error == 0) error = grant(rules, granted, known);
  }
  if (error == 0 && ::syscall(SYS_landlock_restrict_self, rules, 0) != 0) error = errno;
  ::close(rules);
  return error;
}

} // namespace gnomon
