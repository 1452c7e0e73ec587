#pragma once

#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>

#include "protocol/json/json_codec.h"
#include "server/dispatch/dispatcher.h"
#include "server/scenes/upload.h"
#include "tests/support/glb_builder.h"

namespace gnomon::testing {

inline const std::function<bool()> kStays = [] { return false; };

/// Real workers, behind relays that make them go wrong on request (faulty_worker.cpp).
class DispatcherTest : public ::testing::Test {
 protected:
  std::unique_ptr<Dispatcher> start(std::size_t workers, DispatcherOptions options = {}) {
    if (options.program == DispatcherOptions().program) options.program = GNOMON_FAULTY_WORKER;
    options.workers = workers;
    options.each.device = DeviceChoice::cpu;
    auto started = Dispatcher::start(options);
    EXPECT_TRUE(started);
    return started ? *std::move(started) : nullptr;
  }

  /// A small frame of a cube; a fault's name makes it go wrong.
  Task frame(const std::string& node = "") const {
    Task task;
    task.order.kind = OrderKind::frame;
    task.order.scene = scene_.id;
    task.order.mediaType = "image/png";
    task.bundle = scene_.file;
    task.request =
        R"({"width": 16, "height": 16)" + (node.empty() ? "" : R"(, "camera": {"node": ")" + node + "\"}") + "}";
    task.deadline = Clock::now() + std::chrono::seconds(60);
    task.client = {"test", "test"};
    return task;
  }

  /// The task as another client's.
  static Task of(const std::string& client, Task task) {
    task.client = {client, client};
    return task;
  }

  static std::string problemOf(const TaskResult& result) {
    return result.outcome.problems.empty() ? "" : std::string(problemName(result.outcome.problems[0].code));
  }

  PackedBundle scene_ = *packed(cube().bundle());
};

} // namespace gnomon::testing
