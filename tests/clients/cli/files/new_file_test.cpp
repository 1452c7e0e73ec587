#include "clients/cli/files/new_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "protocol/base/bytes.h"

namespace gnomon::cli {
namespace {

class NewFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "new_file_test." + std::to_string(::getpid());
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path() const { return folder_ + "/file"; }
  std::string text() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  auto entries() const { return std::distance(std::filesystem::directory_iterator(folder_), {}); }

  std::string folder_;
};

TEST_F(NewFileTest, AppearsOnceItIsFinished) {
  std::ofstream(path()) << "old";
  auto file = NewFile::create(path());
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write(asBytes("new ")));
  ASSERT_TRUE(file->write(asBytes("bytes")));
  EXPECT_EQ(text(), "old");
  ASSERT_TRUE(file->finish());
  EXPECT_EQ(text(), "new bytes");
  EXPECT_EQ(entries(), 1);
}

TEST_F(NewFileTest, LeavesNothingWhereItIsNotFinished) {
  {
    auto file = NewFile::create(path());
    ASSERT_TRUE(file);
    const NewFile moved = *std::move(file);
    EXPECT_EQ(entries(), 1);
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(NewFileTest, MakesTheFoldersOfItsPath) {
  auto file = NewFile::create(folder_ + "/some/where/file");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->finish());
  EXPECT_TRUE(std::filesystem::is_regular_file(folder_ + "/some/where/file"));
}

TEST_F(NewFileTest, NamesThePathAndTheFolderThatCanNotBe) {
  std::ofstream(path()) << "no folder";
  const auto file = NewFile::create(path() + "/file");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.problems().front().pointer, path() + "/file");
  EXPECT_NE(file.problems().front().detail.find("The folder " + path() + " can't be made: "), std::string::npos);
}

} // namespace
} // namespace gnomon::cli
