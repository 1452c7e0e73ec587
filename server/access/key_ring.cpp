#include "server/access/key_ring.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "protocol/base/bytes.h"
#include "server/system/file_descriptor.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;

Problem unreadable(std::string detail) {
  return {ProblemCode::invalidValue, "", std::move(detail), "", ""};
}

Result<std::string> readKeyText(const std::string& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat about {};
  if (!file || ::fstat(file.get(), &about) != 0) {
    return unreadable("The key file can't be opened: " + std::generic_category().message(errno) + ".");
  }
  if (!S_ISREG(about.st_mode)) return unreadable("The key file is no regular file.");
  std::string text;
  std::array<char, 4096> piece;
  while (true) {
    const ssize_t count = ::read(file.get(), piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unreadable("The key file can't be read.");
    if (count == 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(count));
    if (text.size() > kLargestFile) return unreadable("The key file is larger than 1 MiB.");
  }
}

Result<std::vector<AccessKey>> readKeys(const std::string& path) {
  const auto text = readKeyText(path);
  if (!text) return text.problems();
  return parseKeyFile(*text);
}

} // namespace

Result<std::shared_ptr<KeyRing>> KeyRing::open(std::string file) {
  auto keys = readKeys(file);
  if (!keys) return std::move(keys).problems();
  auto ring = std::make_shared<KeyRing>(*std::move(keys));
  ring->file_ = std::move(file);
  return ring;
}

void KeyRing::reload() {
  auto keys = readKeys(file_);
  if (!keys) {
    for (const Problem& problem : keys.problems()) logEvent("keys", problem.detail + " The keys stay as they were.");
    return;
  }
  const std::string count = std::to_string(keys->size());
  {
    const std::lock_guard lock(mutex_);
    keys_ = std::make_shared<const Keys>(*std::move(keys));
  }
  logEvent("keys", "The key file was read again; keys in it: " + count);
  warnOfReaders();
}

void KeyRing::warnOfReaders() const {
  struct stat about {};
  if (::stat(file_.c_str(), &about) != 0 || (about.st_mode & S_IROTH) == 0) return;
  logEvent("keys",
           "Every user of this machine may read the key file. Give it to the server's user or group, and take it from "
           "all others (chmod o-r); a service of systemd gets it by LoadCredential=.");
}

std::optional<AccessKey> KeyRing::withSecret(std::string_view secret) const {
  Sha256 hash;
  hash.add(secret);
  const std::string shown = hash.hex();
  const auto all = keys();
  const AccessKey* found = nullptr;
  for (const AccessKey& key : *all) {
    for (const std::string& known : key.secretHashes) {
      if (equalInConstantTime(known, shown)) found = &key;
    }
  }
  return found == nullptr ? std::nullopt : std::optional(*found);
}

std::optional<AccessKey> KeyRing::named(std::string_view name) const {
  const auto all = keys();
  const auto found = std::find_if(all->begin(), all->end(), [&](const AccessKey& key) { return key.name == name; });
  return found == all->end() ? std::nullopt : std::optional(*found);
}

std::shared_ptr<const KeyRing::Keys> KeyRing::keys() const {
  const std::lock_guard lock(mutex_);
  return keys_;
}

int KeyUsage::wait(const AccessKey& key, Clock::time_point now) {
  const std::lock_guard lock(*mutex_);
  return waitOf(key, refilled(key, now));
}

Admission KeyUsage::admit(const AccessKey& key, Clock::time_point now) {
  const std::lock_guard lock(*mutex_);
  Share& share = refilled(key, now);
  if (const int seconds = waitOf(key, share); seconds > 0) return {nullptr, seconds};
  std::shared_ptr<void> place(&share, [mutex = mutex_, held = shares_[key.name]](void*) {
    const std::lock_guard giving(*mutex);
    --held->running;
  });
  ++share.running;
  if (key.requestsPerSecond > 0) share.tokens -= 1;
  return {std::move(place), 0};
}

KeyUsage::Share& KeyUsage::refilled(const AccessKey& key, Clock::time_point now) {
  std::shared_ptr<Share>& held = shares_[key.name];
  if (!held) held = std::make_shared<Share>();
  const std::chrono::duration<double> since = now - held->filled;
  const double gained = held->isNew ? key.burst : key.requestsPerSecond * std::max(since.count(), 0.0);
  held->tokens = std::min(held->tokens + gained, key.burst);
  held->filled = now;
  held->isNew = false;
  return *held;
}

int KeyUsage::waitOf(const AccessKey& key, const Share& share) {
  constexpr double kAlmostWhole = 1 - 1e-9; // what comes in pieces adds up to a little less than one
  if (key.requestsPerSecond > 0 && share.tokens < kAlmostWhole) {
    return std::max(1, static_cast<int>(std::ceil((1 - share.tokens) / key.requestsPerSecond)));
  }
  return key.concurrent > 0 && share.running >= key.concurrent ? 1 : 0;
}

} // namespace gnomon
