#pragma once

namespace gnomon {

/// Owns a file descriptor.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor() { reset(); }
  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  int release();
  void reset();

 private:
  int fd_ = -1;
};

/// A signal that many threads can wait for together with their sockets: its descriptor is readable once it is raised.
class StopSignal {
 public:
  StopSignal();
  void raise() noexcept;
  bool raised() const;
  int fd() const { return event_.get(); }

 private:
  FileDescriptor event_;
};

} // namespace gnomon
