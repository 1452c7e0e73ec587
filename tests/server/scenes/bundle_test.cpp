#include "server/wire/bundle.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

#include "protocol/base/scene_id.h"
#include "server/scenes/upload.h"

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

} // namespace
} // namespace gnomon
