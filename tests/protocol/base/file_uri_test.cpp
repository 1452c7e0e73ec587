#include "protocol/base/file_uri.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

std::string nameOf(std::string_view uri) {
  const auto file = fileUri(uri);
  return file ? file->name : "none";
}

TEST(FileUri, NamesAreOfPlainFolders) {
  for (const char* uri :
       {"a/b.png", "./a/b.png", "a//b.png", "a/c/../b.png", "a%2Fb.png", "a\\b.png", ".\\a%5cb.png"}) {
    EXPECT_EQ(nameOf(uri), "a/b.png") << uri;
    EXPECT_FALSE(fileUri(uri)->isOutside) << uri;
    EXPECT_EQ(fileUri(uri)->hasBackslash, std::string_view(uri).find_first_of("\\5") != std::string_view::npos) << uri;
  }
  EXPECT_EQ(nameOf("a%20b.png"), "a b.png");
}

TEST(FileUri, WhatIsElsewhereIsToldApart) {
  const std::pair<const char*, const char*> names[] = {{"../b.png", "_up/b.png"},
                                                       {"a/../../b.png", "_up/b.png"},
                                                       {"..\\..\\b.png", "_up/_up/b.png"},
                                                       {"/a/b.png", "_root/a/b.png"},
                                                       {"/../a/b.png", "_root/a/b.png"},
                                                       {"//host/b.png", "_root/host/b.png"},
                                                       {"file:///a/b.png", "_root/a/b.png"},
                                                       {"file://localhost/a/b%20c.png", "_root/a/b c.png"}};
  for (const auto& [uri, name] : names) {
    EXPECT_EQ(nameOf(uri), name) << uri;
    EXPECT_TRUE(fileUri(uri)->isOutside) << uri;
  }
  EXPECT_EQ(fileUri("file:///a/b.png")->path, "/a/b.png");
  EXPECT_EQ(fileUri("..\\b.png")->path, "../b.png");
}

TEST(FileUri, OtherAddressesAreNone) {
  for (const char* uri :
       {"data:,x", "http://a/b.png", "c:\\a\\b.png", "", ".", "..", "/", "a/..", "a%zz", "a%00b", "a%0Ab"}) {
    EXPECT_EQ(nameOf(uri), "none") << uri;
  }
}

} // namespace
} // namespace gnomon
