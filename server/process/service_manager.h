#pragma once

#include <functional>
#include <string>
#include <thread>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

/// Notifications to a service manager (sd_notify(3)) that has started this process: systemd with Type=notify.
namespace gnomon {

/// Whether one listens.
bool hasServiceManager();

void tellReady(const std::string& status);
void tellReloading();

/// `needed`: for how long it may take.
void tellStopping(std::chrono::seconds needed);

/// Whether GET /livez is answered with 200 at the address that a server listens on, within the time. Wildcard addresses
/// are reached by the loopback interface.
bool answersLivez(const std::string& bind, int port, std::chrono::milliseconds patience);

/// Where the service manager has a watchdog (WatchdogSec=), notifies it for as long as `isWell`
/// says it, three times in the time that it gives.
class Watchdog {
 public:
  explicit Watchdog(std::function<bool(std::chrono::milliseconds patience)> isWell);
  ~Watchdog();

 private:
  StopSignal stop_;
  std::thread thread_;
};

} // namespace gnomon
