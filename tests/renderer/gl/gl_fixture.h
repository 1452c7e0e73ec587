#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>

#include "renderer/gl/context.h"
#include "renderer/gl/context_setup.h"
#include "renderer/gl/debug_log.h"

namespace gnomon::gl {

/// Why a back end can't be tested on this machine; empty = it can.
inline std::string missing(Backend backend) {
  if (backend == Backend::auto_ && missing(Backend::egl).empty()) return {};
  return SharedLibrary(backend == Backend::egl ? "libEGL.so.1" : "libOSMesa.so.8").failure();
}

inline std::string detailsOf(const Problems& problems) {
  std::string details;
  for (const Problem& problem : problems) details += problem.detail + "\n";
  return details;
}

/// A test with a context, which fails on every complaint of the driver that it does not take itself.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = missing(Backend::auto_); !why.empty()) GTEST_SKIP() << why;
    Result<std::unique_ptr<Context>> context = createContext({});
    ASSERT_TRUE(context) << detailsOf(context.problems());
    context_ = *std::move(context);
  }
  void TearDown() override { EXPECT_THAT(takeDebugErrors(), testing::IsEmpty()); }

  std::unique_ptr<Context> context_;
};

} // namespace gnomon::gl
