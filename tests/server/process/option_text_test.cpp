#include "server/process/option_text.h"

#include <charconv>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/process/resource_plan.h"
#include "server/process/serve_inputs.h"

namespace gnomon {
namespace {

constexpr OptionValue kSize{kBytes, {1'024, 1ull << 50}};
constexpr OptionValue kTime{kSeconds, {0, 86'400}};
constexpr OptionValue kCount{"", {1, 64}};

/// The number alone, or what is wrong.
std::string plain(std::string text, const OptionValue& value) {
  const std::string fault = toPlainNumber(text, value);
  return fault.empty() ? text : fault;
}

TEST(OptionText, NumbersTakeTheirUnits) {
  EXPECT_EQ(plain("2048", kSize), "2048");
  EXPECT_EQ(plain("2048b", kSize), "2048");
  for (const char* text : {"512MB", "512 mb", "512MiB", "512m", "512Mi", " 0524288KB "}) {
    EXPECT_EQ(plain(text, kSize), "536870912") << text;
  }
  EXPECT_EQ(plain("1PB", kSize), "1125899906842624");
  EXPECT_EQ(plain("90s", kTime), "90");
  EXPECT_EQ(plain("2 H", kTime), "7200");
  EXPECT_EQ(plain("1d", kTime), "86400");
  EXPECT_EQ(plain("064", kCount), "64");
}

TEST(OptionText, WhatIsOutOfTheRangeIsRefusedWithIt) {
  EXPECT_EQ(plain("-1", kSize), "-1 is not within 1KB..1PB, with units KB, MB, GB, TB and PB.");
  EXPECT_EQ(plain("25h", kTime), "25h is not within 0..86400, with units s, m, h and d.");
  EXPECT_EQ(plain("0", kCount), "0 is not within 1..64.");
  EXPECT_EQ(plain("", kCount), "An empty text is not within 1..64.");
  for (const char* text : {"1023", "2PB", "1025TB", "18446744073709551616", "16777216TB", "-1MB", "+1MB", "1.5MB",
                           "1e9", "0x1000", "MB", "1MBB", "1XB", "1 M B", "4096s"}) {
    EXPECT_NE(plain(text, kSize).find(" is not within 1KB..1PB"), std::string::npos) << text;
  }
  EXPECT_NE(plain("1KB", kCount).find("not within"), std::string::npos);
}

RC_GTEST_PROP(OptionText, ANumberIsWithinTheRangeOrTheTextStays, (const std::string& tail)) {
  const std::string given =
      *rc::gen::elementOf(std::vector<std::string>{"", "-", "1", "1024", "99999999999999999999"}) + tail;
  std::string text = given;
  if (!toPlainNumber(text, kSize).empty()) {
    RC_ASSERT(text == given);
    return;
  }
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  RC_ASSERT(error == std::errc() && end == text.data() + text.size());
  RC_ASSERT(kSize.range.contains(static_cast<double>(number)));
}

TEST(ServeInputs, APasswordIsInNoFault) {
  for (const char* text :
       {"redis://:secret@", "redis://u:secret@h:99999", "redis://:secret%@h", "http://u:secret@h/"}) {
    ServeOptions options;
    options.store = options.jobsAddress = text;
    std::vector<OptionFault> faults;
    const ServeInputs inputs = readAddresses(options, faults);
    EXPECT_FALSE(inputs.store || inputs.jobs) << text;
    ASSERT_EQ(faults.size(), 2u) << text;
    for (const OptionFault& fault : faults) EXPECT_EQ(fault.detail.find("secret"), std::string::npos) << fault.detail;
  }
}

TEST(ServeInputs, AddressesAreReadOnceAndEachFaultNamesItsOption) {
  ServeOptions options;
  options.trustedProxies = {"10.0.0.0/8", "foo", "10.0.0.1/8"};
  options.store = "redis://scenes.example:6400/3";
  options.jobsAddress = "/a/directory";
  std::vector<OptionFault> faults;
  const ServeInputs inputs = readAddresses(options, faults);
  EXPECT_EQ(inputs.store->host, "scenes.example");
  EXPECT_EQ(inputs.store->database, 3);
  EXPECT_FALSE(inputs.jobs);
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_TRUE(faults[0].detail.starts_with("--trusted-proxies: foo: ")) << faults[0].detail;
  EXPECT_TRUE(faults[1].detail.starts_with("--trusted-proxies: 10.0.0.1/8: ")) << faults[1].detail;
  EXPECT_TRUE(faults[2].detail.starts_with("--jobs: ")) << faults[2].detail;
  EXPECT_EQ(readAddresses({}, faults = {}).trustedProxies.size(), 0u);
  EXPECT_TRUE(faults.empty());
}

TEST(ServeInputs, TheDefaultsOfNoMachineContradictEachOther) {
  for (std::uint64_t memory = 64u << 20; memory <= 1ull << 40; memory *= 2) {
    EXPECT_TRUE(conflictsOf(fittedTo(memory)).empty()) << memory;
  }
}

} // namespace
} // namespace gnomon
