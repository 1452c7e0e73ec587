#include "clients/cli/files/output_names.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <rapidcheck.h>

#include "clients/cli/files/file_io.h"
#include "protocol/base/bytes.h"

namespace gnomon::cli {
namespace {

TEST(FilledIn, PutsValuesInPlaceAndLeavesTheView) {
  EXPECT_EQ(*filledIn("{a}/{b}-{a}.{view}.png", {{"a", "x"}, {"b", "y"}}), "x/y-x.{view}.png");
  EXPECT_EQ(*filledIn("{} {A} { {1}", {}), "{} {A} { {1}");
  EXPECT_FALSE(filledIn("{frame}.png", {{"scene", "x"}}));
}

TEST(FilledIn, AValueNeverLeadsToAnotherFolder) {
  EXPECT_EQ(*filledIn("out/{a}.png", {{"a", "../../etc/passwd"}}), "out/.._.._etc_passwd.png");
  EXPECT_EQ(*filledIn("out/{a}/x.png", {{"a", ".."}}), "out/_/x.png");
  rc::check([](const std::string& value) {
    RC_ASSERT(filledIn("{a}", {{"a", value}})->find('/') == std::string::npos);
    RC_ASSERT(*filledIn("{a}", {{"a", value}}) != "..");
  });
}

TEST(BatchItems, AreEveryCameraOfEverySceneSceneByScene) {
  const auto items = batchItems({{"d/a.glb", "-"}, {"x", "y"}, "{scene}-{camera}.png", "{scene}{camera}.json"});
  ASSERT_TRUE(items);
  ASSERT_EQ(items->size(), 4u);
  EXPECT_EQ((*items)[1].output, "a-y.png");
  EXPECT_EQ((*items)[2].output, "stdin-x.png");
  EXPECT_EQ((*items)[3].report, "stdiny.json");
}

TEST(BatchItems, WithoutACameraTheNameIsDefault) {
  EXPECT_EQ(batchItems({{"a.glb"}, {}, "{camera}.png", ""})->front().output, "default.png");
}

TEST(BatchItems, TwoPicturesAreNeverOneFile) {
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "x.png", ""}));
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "-", ""}));
  EXPECT_FALSE(batchItems({{"a.glb", "b.glb"}, {}, "{scene}.png", "r.json"}));
}

TEST(BatchItems, OfPicturesThatWouldBeOneFileTheFirstIsMadeAndWhatIsMissingIsTold) {
  const auto items = batchItems({{"1/a.glb", "1/b.glb", "2/a.glb"}, {}, "{scene}.png", ""});
  ASSERT_TRUE(items);
  EXPECT_FALSE((*items)[0].collision);
  EXPECT_FALSE((*items)[1].collision);
  ASSERT_TRUE((*items)[2].collision);
  EXPECT_NE((*items)[2].collision->detail.find("1/a.glb"), std::string::npos);
  EXPECT_EQ((*items)[2].collision->limit, "a name with {folder}");
  const auto cameras = batchItems({{"a.glb"}, {"x", "y"}, "{scene}.png", ""});
  EXPECT_EQ((*cameras)[1].collision->limit, "a name with {camera}");
  const auto same = batchItems({{"a.glb"}, {"x/y", "x_y"}, "{camera}.png", ""});
  EXPECT_EQ((*same)[1].collision->limit, "");
  const auto reports = batchItems({{"1/a.glb", "2/a.glb"}, {}, "{folder}-{scene}.png", "{scene}.json"});
  EXPECT_EQ((*reports)[1].collision->pointer, "--report");
}

TEST(BatchItems, AFolderIsThatOfTheScene) {
  const auto items = batchItems({{"x/1/a.glb", "x/2/../3/a.glb", "a.glb", "-"}, {}, "{folder}.png", ""});
  ASSERT_TRUE(items);
  EXPECT_EQ((*items)[0].output, "1.png");
  EXPECT_EQ((*items)[1].output, "3.png");
  EXPECT_EQ((*items)[2].output, std::filesystem::current_path().filename().string() + ".png");
  EXPECT_EQ((*items)[3].output, "stdin.png");
}

TEST(FrameNumber, Sorts) {
  EXPECT_EQ(frameNumber(7), "00007");
  EXPECT_EQ(frameNumber(123456), "123456");
}

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

} // namespace
} // namespace gnomon::cli
