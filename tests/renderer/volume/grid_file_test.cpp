#include <gtest/gtest.h>

#include "protocol/base/bytes.h"
#include "renderer/volume/density_grid.h"
#include "tests/renderer/volume/vdb_builder.h"

namespace gnomon {
namespace {

const std::string kNpy =
    std::string("\x93NUMPY\x01\0\x37\0", 10) + "{'descr':'|u1','fortran_order':False,'shape':(1,1,2)}  " + "\x01\x02";

TEST(GridFile, ItsFirstBytesSayWhatItIs) {
  const auto npy = readGridFile(asBytes(kNpy));
  ASSERT_TRUE(npy) << npy.problems().front().detail;
  EXPECT_EQ(npy->values, (std::vector<float>{1, 2}));
  const auto vdb = readGridFile(asBytes(vdbFile({{"density", {{{5, 5, 5}, 3}}}})), "density");
  ASSERT_TRUE(vdb);
  EXPECT_EQ(vdb->values, (std::vector<float>{3}));
  for (const char* other : {"", "glTF", "\x93NUM"}) {
    const auto grid = readGridFile(asBytes(other));
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.problems().front().code, ProblemCode::unsupportedFeature);
    EXPECT_EQ(grid.problems().front().limit, "NumPy's .npy, OpenVDB's .vdb");
  }
}

TEST(GridFile, ANameIsForFilesOfSeveralGrids) {
  const auto grid = readGridFile(asBytes(kNpy), "density");
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.problems().front().actual, "density");
}

} // namespace
} // namespace gnomon
