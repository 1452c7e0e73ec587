#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "protocol/base/bytes.h"
#include "renderer/volume/density_grid.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string little(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> 8 * i);
  return text;
}

std::string npy(const std::string& header, const std::string& data, int major = 1) {
  return std::string("\x93NUMPY") + static_cast<char>(major) + '\0' + little(header.size(), major == 1 ? 2 : 4) +
         header + data;
}

std::string header(const std::string& descr, const std::string& shape, const std::string& order = "False") {
  return "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }      \n";
}

std::string floats(const std::vector<float>& numbers) {
  std::string data;
  for (const float number : numbers) data += little(std::bit_cast<std::uint32_t>(number), 4);
  return data;
}

Result<DensityGrid> read(const std::string& file) {
  return readNpy(asBytes(file));
}

Problem refusal(const std::string& file) {
  const auto grid = read(file);
  EXPECT_FALSE(grid);
  return grid ? Problem{} : grid.problems().front();
}

TEST(Npy, TheLastAxisIsX) {
  const auto grid = read(npy(header("<f4", "(1, 2, 3)"), floats({1, 2, 3, 4, 5, -6.5})));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->size, glm::ivec3(3, 2, 1));
  EXPECT_THAT(grid->values, ElementsAre(1, 2, 3, 4, 5, -6.5));
  EXPECT_EQ(grid->at(2, 1, 0), -6.5f);
}

TEST(Npy, ReadsHalvesAndBytes) {
  const auto halves = read(npy(header("<f2", "(2, 1, 1)"), little(0x3c00, 2) + little(0xc000, 2)));
  ASSERT_TRUE(halves);
  EXPECT_THAT(halves->values, ElementsAre(1, -2));
  const auto bytes = read(npy(header("|u1", "(1, 1, 3)"), std::string("\x00\x80\xff", 3)));
  ASSERT_TRUE(bytes);
  EXPECT_THAT(bytes->values, ElementsAre(0, 128, 255));
}

TEST(Npy, ReadsVersionsOneToThreeAndTheHeadersOfOtherWriters) {
  const std::string data = floats({7});
  for (const int major : {1, 2, 3}) EXPECT_TRUE(read(npy(header("<f4", "(1, 1, 1)"), data, major))) << major;
  EXPECT_TRUE(read(npy("{\"shape\":(1,1,1),\"descr\":\"<f4\",\"fortran_order\":False}", data)));
  EXPECT_TRUE(read(npy("  { 'shape' : ( 1 , 1 , 1 , ) , 'fortran_order':False, 'descr':'<f4' , } \n", data)));
  EXPECT_EQ(refusal(npy(header("<f4", "(1, 1, 1)"), data, 4)).limit, "1..3");
  EXPECT_EQ(refusal(npy(header("<f4", "(1, 1, 1)"), data, 0)).limit, "1..3");
}

TEST(Npy, EveryCutIsRefused) {
  const std::string whole = npy(header("<f4", "(1, 2, 2)"), floats({1, 2, 3, 4}));
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_EQ(refusal(whole.substr(0, size)).code, ProblemCode::malformed) << size;
  }
  EXPECT_EQ(refusal(whole + '\0').code, ProblemCode::malformed);
}

TEST(Npy, LiesAboutSizeTakeNoMemory) {
  const Problem more = refusal(npy(header("<f4", "(512, 512, 512)"), floats({1})));
  EXPECT_EQ(more.code, ProblemCode::malformed);
  EXPECT_EQ(more.limit, "536870912 bytes");
  EXPECT_EQ(more.actual, "4");
  const Problem wide = refusal(npy(header("<f4", "(1, 1, 100000)"), floats({1})));
  EXPECT_EQ(wide.code, ProblemCode::tooLarge);
  EXPECT_EQ(wide.limit, "1..2048");
  EXPECT_EQ(refusal(npy(header("<f4", "(2048, 2048, 2048)"), floats({1}))).code, ProblemCode::tooLarge);
  EXPECT_EQ(refusal(npy(header("<f4", "(9223372036854775807, 9223372036854775807, 4)"), "")).code,
            ProblemCode::tooLarge);
  EXPECT_EQ(refusal(npy(header("<f4", "(99999999999999999999, 1, 1)"), "")).code, ProblemCode::malformed);
  EXPECT_EQ(refusal(npy(header("<f4", "(1, 0, 1)"), "")).code, ProblemCode::invalidValue);
  EXPECT_EQ(refusal(npy(header("<f4", "(1, -1, 1)"), "")).code, ProblemCode::invalidValue);
  const Problem endless = refusal(std::string("\x93NUMPY\x02\0", 8) + little(0xffffffffu, 4));
  EXPECT_EQ(endless.code, ProblemCode::tooLarge);
  EXPECT_EQ(endless.limit, "65536 bytes");
}

TEST(Npy, WhatIsNotReadIsNamedWithWhatIs) {
  const std::string data(64, '\0');
  for (const char* descr : {">f4", "<f8", "<i4", "|b1", "|O", "", "<f4 "}) {
    const Problem problem = refusal(npy(header(descr, "(1, 1, 1)"), data));
    EXPECT_EQ(problem.code, ProblemCode::unsupportedFeature) << descr;
    EXPECT_EQ(problem.limit, "<f4, <f2, |u1");
    EXPECT_EQ(problem.actual, descr);
  }
  EXPECT_EQ(refusal(npy(header("<f4", "(1, 1, 1)", "True"), floats({1}))).limit, "fortran_order False");
  for (const char* shape : {"()", "(4,)", "(2, 2)", "(1, 1, 1, 1)"}) {
    EXPECT_EQ(refusal(npy(header("<f4", shape), data)).limit, "3") << shape;
  }
}

TEST(Npy, ABrokenHeaderIsRefused) {
  for (const char* text :
       {"", "{", "{}", "[]", "{'descr': '<f4', 'fortran_order': False}", "{'descr': '<f4', 'shape': (1,1,1)}",
        "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (1,1,1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1,1,1), 'more': 1}",
        "{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (1,1,1)}",
        "{'descr': '<f4, 'fortran_order': False, 'shape': (1,1,1)}",
        "{'descr': '<f4', 'fortran_order': 0, 'shape': (1,1,1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1L,1,1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1,,1,1)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': [1,1,1]}",

        "{'descr': '<f4' 'fortran_order': False, 'shape': (1,1,1)}"}) {
    const Problem problem = refusal(npy(text, floats({1})));
    EXPECT_EQ(problem.code, ProblemCode::malformed) << text;
    EXPECT_THAT(problem.detail, HasSubstr("broken: its ")) << text;
  }
  EXPECT_EQ(refusal("PK\3\4 an archive").code, ProblemCode::malformed);
}

TEST(Npy, WhatIsNotFiniteIsRefusedWithItsPlace) {
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal(npy(header("<f4", "(2, 1, 2)"), floats({0, 0, 0, infinite}))).detail, HasSubstr("x 1, y 0, z 1"));
  EXPECT_THAT(refusal(npy(header("<f2", "(1, 2, 1)"), little(0, 2) + little(0x7e00, 2))).detail,
              HasSubstr("x 0, y 1, z 0"));
}

} // namespace
} // namespace gnomon
