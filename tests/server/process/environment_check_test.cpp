#include "server/process/environment_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/base/nearest_name.h"

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

TEST(NearestName, IsTheOneWithTheFewestChangesIfThereAreFew) {
  EXPECT_EQ(nearestName("worker", std::vector<std::string>{"port", "workers", "worker-program"}), "workers");
  EXPECT_EQ(nearestName("bindd", std::vector<std::string>{"bind", "grace"}), "bind");
  EXPECT_EQ(nearestName("velocity", std::vector<std::string>{"bind", "grace"}), "");
  EXPECT_EQ(nearestName(std::string(100'000, 'a'), std::vector<std::string>{"bind"}), "");
}

} // namespace
} // namespace gnomon
