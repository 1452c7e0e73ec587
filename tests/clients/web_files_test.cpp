#include "clients/web/web_files.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <sstream>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::map<std::string, WebFile> filesByPath() {
  std::map<std::string, WebFile> files;
  for (const WebFile& file : webFiles()) files.emplace(file.path, file);
  return files;
}

std::string fileText(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// What the first group of `pattern` matches, everywhere in `text`.
std::vector<std::string> allMatches(std::string_view text, const char* pattern) {
  const std::string whole(text);
  const std::regex regex(pattern);
  std::vector<std::string> matches;
  for (std::sregex_iterator at(whole.begin(), whole.end(), regex), end; at != end; ++at) matches.push_back((*at)[1]);
  return matches;
}

/// As embed_files.cmake leaves it: without indentation, empty lines, lines of modules and styles that only comment, and
/// a style's spaces around what separates its parts.
std::string slim(std::string text, const std::string& suffix) {
  const bool isModule = suffix == ".mjs";
  if (suffix == ".css") {
    text = std::regex_replace(text, std::regex("\\n/\\*[^*]*\\*/"), "\n");
    text = std::regex_replace(text, std::regex("([;:,{]) +"), "$1");
    text = std::regex_replace(text, std::regex(" +\\{"), "{");
  }
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(" \t"));
    if (line.empty() || (isModule && line.starts_with("//"))) continue;
    kept += line + '\n';
  }
  return kept;
}

TEST(WebFiles, AreTheFilesOfTheFolderWithoutIndentationAndComments) {
  const auto files = filesByPath();
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(GNOMON_WEB_FOLDER)) {
    const std::string suffix = entry.path().extension();
    if (suffix != ".html" && suffix != ".css" && suffix != ".mjs" && suffix != ".svg") continue;
    const std::string name = entry.path().filename();
    const auto found = files.find(name == "index.html" ? "/" : "/" + name);
    ASSERT_NE(found, files.end()) << name << " is not in clients/web/CMakeLists.txt";
    const std::string expected = slim(fileText(entry.path()), suffix);
    EXPECT_EQ(slim(std::string(found->second.bytes), suffix), expected) << name;
    EXPECT_LE(found->second.bytes.size(), expected.size() + 1) << name;
    ++count;
  }
  EXPECT_EQ(count, files.size());
  EXPECT_EQ(files.size(), webFiles().size()) << "a path comes twice";
}

TEST(WebFiles, AreSmallTogether) {
  std::size_t bytes = 0;
  for (const WebFile& file : webFiles()) bytes += file.bytes.size();
  EXPECT_LT(bytes, 165'000u);
}

TEST(WebFiles, HaveTheirContentTypes) {
  const auto files = filesByPath();
  EXPECT_EQ(files.at("/").contentType, "text/html; charset=utf-8");
  EXPECT_EQ(files.at("/style.css").contentType, "text/css; charset=utf-8");
  EXPECT_EQ(files.at("/app.mjs").contentType, "text/javascript; charset=utf-8");
  EXPECT_EQ(files.at("/favicon.svg").contentType, "image/svg+xml");
}

TEST(WebFiles, ThePageNamesOnlyFilesThatThereAre) {
  const auto files = filesByPath();
  const auto names = allMatches(files.at("/").bytes, R"re((?:src|href)="([^"]+)")re");
  EXPECT_THAT(names, testing::IsSupersetOf({"app.mjs", "style.css"}));
  for (const std::string& name : names) {
    EXPECT_TRUE(name == "openapi.json" || files.contains("/" + name)) << name;
  }
}

TEST(WebFiles, ModulesImportOnlyModulesThatThereAre) {
  const auto files = filesByPath();
  for (const auto& [path, file] : files) {
    if (!path.ends_with(".mjs")) continue;
    for (const std::string& name : allMatches(file.bytes, R"re(from '([^']+)')re")) {
      ASSERT_TRUE(name.starts_with("./")) << path << " imports " << name;
      EXPECT_TRUE(files.contains(name.substr(1))) << path << " imports " << name;
    }
  }
}

TEST(WebFiles, NothingIsFetchedFromElsewhere) {
  for (const auto& [path, file] : filesByPath()) {
    for (const std::string& address : allMatches(file.bytes, R"re(((?:https?:)?//[a-zA-Z0-9][^\s'"`]*))re")) {
      EXPECT_EQ(address, "http://www.w3.org/2000/svg") << path; // a namespace, never fetched
    }
  }
}

} // namespace
} // namespace gnomon
