#include "server/wire/bundle.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

#include "protocol/base/scene_bundle.h"
#include "server/bakes/bake_registry.h"
#include "server/scenes/stored_light_maps.h"
#include "server/scenes/upload.h"
#include "server/system/file_descriptor.h"

namespace gnomon {
namespace {

Bytes written(const SceneBundle& bundle) {
  Bytes bytes;
  writeBundle(bundle,
              [&](std::span<const std::uint8_t> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
  return bytes;
}

TEST(BundleFormat, AModelAloneIsItself) {
  const SceneBundle bundle{{'a', 'b', 'c'}, {}};
  EXPECT_EQ(written(bundle), bundle.model);
  EXPECT_EQ(packed(bundle)->id, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"); // FIPS 180-2
  EXPECT_EQ(packed(bundle)->bytes, 3u);
}

TEST(BundleFormat, ReadsWhatItWrote) {
  EXPECT_TRUE(rc::check([](const Bytes& model, const std::vector<Bytes>& contents) {
    SceneBundle bundle{model, {}};
    for (std::size_t i = 0; i < std::min<std::size_t>(contents.size(), 20); ++i) {
      bundle.files["d/" + std::to_string(i)] = contents[i];
    }
    const Bytes bytes = written(bundle);
    const auto read = readBundle(bytes);
    RC_ASSERT(static_cast<bool>(read));
    RC_ASSERT(read->model == bundle.model);
    RC_ASSERT(read->files == bundle.files);
    RC_ASSERT(packed(bundle)->bytes == bytes.size());
  }));
}

TEST(BundleFormat, NoCutIsWhole) {
  const SceneBundle bundle{{1, 2, 3}, {{"a", {4}}, {"b", {}}}};
  const Bytes bytes = written(bundle);
  for (std::size_t length = 16; length < bytes.size(); ++length) {
    const auto read = readBundle(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_TRUE(!read || read->files.size() < 2) << length;
  }
}

TEST(BundleFormat, HasOneFormForOneBundle) {
  const auto isRead = [](const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string text = "gnomon bundle 1\n";
    for (const auto& [name, content] : entries) {
      text += static_cast<char>(name.size()) + std::string(3, '\0') + static_cast<char>(content.size()) +
              std::string(7, '\0') + name + content;
    }
    return static_cast<bool>(readBundle(Bytes(text.begin(), text.end())));
  };
  EXPECT_TRUE(isRead({{"", "model"}, {"a", "1"}, {"b", "2"}}));
  EXPECT_FALSE(isRead({})) << "no model";
  EXPECT_FALSE(isRead({{"", "model"}})) << "a model alone is its own bytes";
  EXPECT_FALSE(isRead({{"m", "model"}, {"a", "1"}})) << "the model has no name";
  EXPECT_FALSE(isRead({{"", "model"}, {"b", "2"}, {"a", "1"}})) << "names ascend";
  EXPECT_FALSE(isRead({{"", "model"}, {"a", "1"}, {"a", "1"}})) << "names come once";
}

TEST(BundleFormat, SurvivesLyingLengths) {
  Bytes bytes = written({{1}, {{"a", {2}}}});
  for (std::size_t at = 16; at < 28; ++at) {
    Bytes lying = bytes;
    lying[at] = 0xff;
    EXPECT_FALSE(readBundle(lying)) << at;
  }
}

TEST(BundleFormat, TheIdTellsNamesAndContentsApart) {
  const std::vector<SceneBundle> bundles{
      {{1}, {}}, {{1}, {{"a", {}}}}, {{1}, {{"b", {}}}}, {{1}, {{"a", {2}}}}, {{1, 2}, {{"a", {}}}}};
  std::set<std::string> ids;
  for (const SceneBundle& bundle : bundles) {
    ids.insert(packed(bundle)->id);
  }
  EXPECT_EQ(ids.size(), bundles.size());
}

TEST(BundleFormat, KnowsIds) {
  EXPECT_TRUE(isSceneId(std::string(64, 'a')));
  EXPECT_FALSE(isSceneId(std::string(63, 'a')));
  EXPECT_FALSE(isSceneId(std::string(64, 'A')));
  EXPECT_FALSE(isSceneId("../" + std::string(61, 'a')));
}

TEST(BundleFormat, KnowsFileNames) {
  for (const char* good : {"a", "a b.png", "textures/a.png", "❤♻.bin", "...", "a..b"}) {
    EXPECT_TRUE(isBundleFileName(good)) << good;
  }
  for (const char* bad : {"", "/a", "a/", "a//b", ".", "..", "../a", "a/..", "a\\b", "data:x", "a\nb", "\x7f"}) {
    EXPECT_FALSE(isBundleFileName(bad)) << bad;
  }
  EXPECT_FALSE(isBundleFileName(std::string(256, 'a')));
}

std::string formPart(const std::string& disposition, const std::string& content) {
  return "--B\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n" + content + "\r\n";
}

Result<SceneBundle> bundled(const std::string& opened) {
  const std::string body = opened + "--B--";
  const auto parts = parseMultipart(body, "B", 300);
  EXPECT_TRUE(parts);
  return bundleFromParts(*parts, {"spec"});
}

TEST(Multipart, MakesABundle) {
  const auto bundle =
      bundled(formPart("name=scene; filename=a.gltf", "model") + formPart("name=file; filename=\"t/b.png\"", "1") +
              formPart("name=\"c d.bin\"; filename=other", "2") + formPart("name=spec", "{}"));
  ASSERT_TRUE(bundle);
  EXPECT_EQ(asText(bundle->model), "model");
  EXPECT_EQ(bundle->files, (std::map<std::string, Bytes>{{"t/b.png", {'1'}}, {"c d.bin", {'2'}}}));
}

TEST(Multipart, RefusesNamesThatLeaveTheBundle) {
  for (const char* name : {"../a", "/etc/passwd", "a/../../b", "a//b", "a/./b", "..", "C:\\\\a", "a\\\\b", "file:a"}) {
    const auto bundle =
        bundled(formPart("name=scene", "m") + formPart(std::string("name=file; filename=\"") + name + "\"", ""));
    ASSERT_FALSE(bundle) << name;
    EXPECT_EQ(bundle.problems().front().pointer, "file") << name;
  }
}

TEST(Multipart, RefusesDuplicates) {
  const std::string model = formPart("name=scene", "m");
  EXPECT_FALSE(bundled(model + model));
  EXPECT_FALSE(bundled(model + formPart("name=file; filename=a", "1") + formPart("name=a", "2")));
}

TEST(Multipart, RefusesAFormWithoutAModel) {
  const auto bundle = bundled(formPart("name=a", "1") + formPart("name=file", "nameless"));
  ASSERT_FALSE(bundle);
  EXPECT_EQ(bundle.problems().size(), 2u);
  EXPECT_EQ(bundle.problems().back().pointer, "scene");
}

class LightMapDirectoryTest : public ::testing::Test {
 protected:
  LightMapDirectoryTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gnomon-maps-XXXXXX").string();
    path_ = std::string(::mkdtemp(pattern.data())) + "/maps";
  }
  ~LightMapDirectoryTest() override { std::filesystem::remove_all(std::filesystem::path(path_).parent_path()); }

  std::shared_ptr<LightMapDirectory> open(std::size_t budgetBytes) const {
    return std::make_shared<LightMapDirectory>(path_, budgetBytes);
  }

  /// Makes a map look as if it had last been used so many seconds ago.
  void age(const std::string& key, int seconds) const {
    const std::string file = path_ + "/" + key + ".map";
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) - std::chrono::seconds(seconds));
  }

  /// A key of a scene, and of what was baked.
  static std::string key(char scene, char baked) { return std::string(64, scene) + "-" + std::string(64, baked); }

  static void write(LightMapDirectory& maps, const std::string& key, const Bytes& bytes) {
    maps.write(key, *memoryFile(bytes));
  }
  static std::optional<Bytes> read(LightMapDirectory& maps, const std::string& key) {
    const FileDescriptor file = maps.open(key);
    return file ? readFile(file, 1 << 20) : std::nullopt;
  }

  std::string path_;
};

TEST_F(LightMapDirectoryTest, KeepsMapsOverARestart) {
  write(*open(1000), key('a', '1'), {1, 2, 3});
  EXPECT_EQ(read(*open(1000), key('a', '1')), (Bytes{1, 2, 3}));
  EXPECT_FALSE(read(*open(1000), key('a', '2')));
}

TEST_F(LightMapDirectoryTest, DropsWhatWasNotUsedForLongest) {
  const auto maps = open(250);
  for (const std::string& each : {key('a', '1'), key('a', '2')}) write(*maps, each, Bytes(100));
  age(key('a', '1'), 60);
  age(key('a', '2'), 30);
  EXPECT_TRUE(read(*maps, key('a', '1')));
  write(*maps, key('a', '3'), Bytes(100));
  EXPECT_TRUE(read(*maps, key('a', '1')));
  EXPECT_FALSE(read(*maps, key('a', '2')));
  EXPECT_TRUE(read(*maps, key('a', '3')));
  write(*maps, key('a', '4'), Bytes(251));
  EXPECT_FALSE(read(*maps, key('a', '4'))) << "larger than the budget";
  EXPECT_TRUE(read(*maps, key('a', '3')));
  age(key('a', '1'), 10);
  EXPECT_FALSE(read(*open(150), key('a', '1'))) << "a smaller budget than before";
}

TEST_F(LightMapDirectoryTest, RemovesTheMapsOfAScene) {
  const auto maps = open(1000);
  for (const std::string& each : {key('a', '1'), key('a', '2'), key('b', '1')}) write(*maps, each, Bytes(10));
  maps->removeScene(std::string(64, 'a'));
  EXPECT_FALSE(read(*maps, key('a', '1')));
  EXPECT_FALSE(read(*maps, key('a', '2')));
  EXPECT_TRUE(read(*maps, key('b', '1')));
}

TEST_F(LightMapDirectoryTest, WhatTheDiskRefusesIsPassedOver) {
  const auto maps = open(1000);
  write(*maps, key('a', '1'), Bytes(10));
  std::filesystem::remove_all(path_);
  EXPECT_FALSE(read(*maps, key('a', '1')));
  std::filesystem::copy_file("/proc/self/exe", path_); // no directory can be made in its place
  write(*maps, key('a', '1'), Bytes(10));
  EXPECT_FALSE(read(*maps, key('a', '1')));
  maps->removeScene(std::string(64, 'a'));
}

TEST_F(LightMapDirectoryTest, TakesNoKeyThatLeadsElsewhere) {
  const auto maps = open(1000);
  for (const std::string& each : {std::string("../escaped"), std::string("a-1"), key('a', 'G'), key('a', '1') + "/"}) {
    write(*maps, each, {1});
    EXPECT_FALSE(maps->open(each)) << each;
  }
  EXPECT_FALSE(std::filesystem::exists(path_ + "/../escaped.map"));
}

TEST(BakeRegistry, IsFoundOnceItIsDone) {
  BakeRegistry book;
  FrameSpec spec;
  spec.scene = 3;
  book.begin({"a", "1"}, spec);
  EXPECT_FALSE(book.find({"a", "1"}));
  book.end({"a", "1"}, true);
  ASSERT_TRUE(book.find({"a", "1"}));
  EXPECT_EQ(book.find({"a", "1"})->scene, 3);
  EXPECT_FALSE(book.find({"b", "1"})) << "a key belongs to its scene";
  EXPECT_FALSE(book.find({"a", "2"}));
}

TEST(BakeRegistry, WhatFailsIsForgottenButNotWhatWasMadeBefore) {
  BakeRegistry book;
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, false);
  EXPECT_FALSE(book.remove({"a", "1"}));
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, true);
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, false);
  EXPECT_TRUE(book.find({"a", "1"}));
}

TEST(BakeRegistry, RemovingStopsAndForgets) {
  BakeRegistry book;
  const auto removed = book.begin({"a", "1"}, {});
  EXPECT_FALSE(*removed);
  EXPECT_TRUE(book.remove({"a", "1"}));
  EXPECT_TRUE(*removed);
  EXPECT_FALSE(book.remove({"a", "1"}));
  book.end({"a", "1"}, true);
  EXPECT_FALSE(book.find({"a", "1"}));
  EXPECT_FALSE(*book.begin({"a", "1"}, {})) << "a bake after it is another";
}

TEST(BakeRegistry, ForgetsTheOldest) {
  BakeRegistry book;
  for (std::size_t i = 0; i <= BakeRegistry::kMost; ++i) {
    book.begin({"a", std::to_string(i)}, {});
    book.end({"a", std::to_string(i)}, true);
  }
  EXPECT_FALSE(book.find({"a", "0"}));
  EXPECT_TRUE(book.find({"a", "1"}));
}

} // namespace
} // namespace gnomon
