#include "server/process/environment_check.h"

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <unistd.h>

#include "protocol/base/text.h"
#include "server/process/serve_flags.h"
#include "server/process/serve_option_rows.h"
#include "server/process/signals.h"
#include "tests/server/system/pipe.h"
#include "tests/support/page_table.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

const std::vector<std::string> kKnown{"GNOMON_STORE", "GNOMON_LISTEN_PORT", "GNOMON_WORKERS"};

std::vector<std::string> faultsOf(std::vector<std::string> environment) {
  return unknownVariables(environment, kKnown);
}

TEST(EnvironmentCheck, AMisspeltVariableIsRefusedWithTheNearestName) {
  EXPECT_THAT(faultsOf({"PATH=/bin", "GNOMON_STORE=/a", "GNOMON_STOR=/b", "GNOMONSTORE=x"}),
              ElementsAre("There is no environment variable GNOMON_STOR; did you mean GNOMON_STORE?"));
  EXPECT_THAT(faultsOf({"GNOMON_FLUX_CAPACITOR=1"}),
              ElementsAre("There is no environment variable GNOMON_FLUX_CAPACITOR."));
}

TEST(EnvironmentCheck, ANameIsSuggestedOnlyWithinTwoEdits) {
  EXPECT_THAT(faultsOf({"GNOMON_WRKRS=1", "GNOMON_WRKR=1", "GNOMON_SOTRE=/a", "GNOMON_STORED=/a"}),
              ElementsAre("There is no environment variable GNOMON_WRKRS; did you mean GNOMON_WORKERS?",
                          "There is no environment variable GNOMON_WRKR.",
                          "There is no environment variable GNOMON_SOTRE; did you mean GNOMON_STORE?",
                          "There is no environment variable GNOMON_STORED; did you mean GNOMON_STORE?"));
  EXPECT_THAT(faultsOf({"GNOMON_" + std::string(10'000, 'A') + "=1"}).front(), ::testing::EndsWith("...."));
}

TEST(EnvironmentCheck, AFlagsOwnNameLeadsToItsVariable) {
  EXPECT_THAT(
      faultsOf({"GNOMON_PORT=8080", "GNOMON_ADMIN_PORT=9090"}),
      ElementsAre("There is no environment variable GNOMON_PORT; did you mean GNOMON_LISTEN_PORT?",
                  "There is no environment variable GNOMON_ADMIN_PORT; did you mean GNOMON_ADMIN_LISTEN_PORT?"));
}

TEST(EnvironmentCheck, VariablesOfThePythonClientAreKnown) {
  EXPECT_TRUE(faultsOf({"GNOMON_BINARY=/usr/bin/gnomon", "GNOMON_SERVER=http://127.0.0.1:8080"}).empty());
}

TEST(EnvironmentCheck, VariablesOfAServiceAreNobodysMistake) {
  for (const char* entry :
       {"GNOMON_PORT=tcp://10.0.0.1:8080", "GNOMON_SERVICE_HOST=10.0.0.1", "GNOMON_SERVICE_PORT=8080",
        "GNOMON_SERVICE_PORT_HTTP=8080", "GNOMON_SERVICE_PORT_HTTP_ALT=8081",
        "GNOMON_PORT_8080_TCP=tcp://10.0.0.1:8080", "GNOMON_PORT_8080_TCP_PROTO=tcp", "GNOMON_PORT_8080_TCP_PORT=8080",
        "GNOMON_PORT_8080_TCP_ADDR=10.0.0.1", "GNOMON_PORT_53_UDP_ADDR=10.0.0.1", "GNOMON_CANARY_SERVICE_HOST=10.0.0.1",
        "GNOMON_CANARY_PORT_8080_TCP=tcp://10.0.0.1:8080", "GNOMON_STORE_SERVICE_PORT=80"}) {
    EXPECT_TRUE(faultsOf({entry}).empty()) << entry;
  }
}

TEST(EnvironmentCheck, WhatOnlyLooksLikeAServiceIsRefused) {
  for (const char* entry : {"GNOMON_PORT=8080", "GNOMON_LISTN_PORT=8080", "GNOMON_PORT_8080=x", "GNOMON_SERVICE=x",
                            "GNOMON_SERVICE_PORT=http", "GNOMON_PORT_X_TCP=x", "GNOMON_PORT_8080_TCP_SIZE=x",
                            "GNOMON_=x", "GNOMON_SERVICE_HOSTS=x"}) {
    EXPECT_EQ(faultsOf({entry}).size(), 1u) << entry;
  }
}

std::string sizeText(std::uint64_t bytes) {
  if (bytes == 0) return "0";
  return bytes % (1u << 30) == 0 ? std::to_string(bytes >> 30) + " GB" : std::to_string(bytes >> 20) + " MB";
}

std::string defaultOf(const CLI::Option& option, const OptionRow& row) {
  if (std::holds_alternative<bool ServeOptions::*>(row.member)) return "off";
  const std::string text = option.get_default_str();
  if (text.empty()) return "none";
  if (row.value.name == kBytes) return sizeText(std::stoull(text));
  if (row.value.name == kSeconds) return text + " s";
  return "`" + text + "`";
}

std::string optionTable() {
  CLI::App command;
  ServeOptions options;
  addServeFlags(command, options);
  std::string table = "| flag | variable | default | what it is, and what more of it costs |\n|---|---|---|---|\n";
  for (const OptionGroup& group : kOptionGroups) {
    for (const OptionRow& row : group.rows) {
      const std::string flag = "--" + std::string(row.name);
      const CLI::Option& option = *command.get_option(flag);
      table += "| `" + flag + "` | `" + option.get_envname() + "` | " + defaultOf(option, row) + " | ";
      table += std::string(row.says) + " |\n";
    }
  }
  return table;
}

TEST(Readme, TheTableOfServerOptionsIsThatOfTheRows) {
  testing::expectTable(GNOMON_OPERATIONS, "options", optionTable());
}

constexpr Clock::time_point kNow{};

/// On a thread of its own, since signals stay blocked for the thread that makes a Signals.
template <typename Test>
void onThread(Test test) {
  std::thread(test).join();
}

TEST(Signals, APipeThatIsClosedIsToldOnce) {
  onThread([] {
    Pipe pipe;
    Signals signals([] {}, std::move(pipe.reading));
    const StopSignal done;
    EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
    pipe.writing.reset();
    EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::abandoned);
    EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
  });
}

TEST(Signals, WhatIsWrittenIntoThePipeIsDropped) {
  onThread([] {
    Pipe pipe;
    Signals signals([] {}, std::move(pipe.reading));
    const StopSignal done;
    const std::array<char, 10'000> text{};
    ASSERT_EQ(::write(pipe.writing.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    EXPECT_EQ(signals.wait(done, Clock::now() + std::chrono::milliseconds(50)), Signals::Event::timeout);
    pipe.writing.reset();
    EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::abandoned);
  });
}

TEST(Signals, ASignalIsToldWithOrWithoutAPipe) {
  for (const bool hasPipe : {false, true}) {
    onThread([hasPipe] {
      Pipe pipe;
      Signals signals([] {}, hasPipe ? std::move(pipe.reading) : FileDescriptor());
      const StopSignal done;
      ::pthread_kill(::pthread_self(), SIGTERM);
      EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::signal);
      EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
    });
  }
}

} // namespace
} // namespace gnomon
