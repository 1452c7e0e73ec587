#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/access/access_key.h"

namespace gnomon::cli {
namespace {

struct SignOptions {
  std::string url;
  std::string keyFile;
  std::string keyName;
  std::int64_t seconds = 0;
};

constexpr std::size_t kLargestFile = 1 << 20;

/// The length of the part of an address before its path; nothing where it is no address of a frame.
std::optional<std::size_t> frameTargetBegin(std::string_view url) {
  const bool isPlain = std::all_of(url.begin(), url.end(), [](char c) { return c > ' ' && c < 0x7f && c != '#'; });
  const std::size_t scheme = url.find("://");
  const std::size_t path = url.find('/', scheme < url.find('/') ? scheme + 3 : 0);
  if (!isPlain || path == std::string_view::npos) return std::nullopt;
  const std::string_view target = url.substr(path);
  const bool isFrame = target.starts_with("/v1/scenes/") && target.substr(0, target.find('?')).ends_with("/frame");
  return isFrame ? std::optional(path) : std::nullopt;
}

Result<AccessKey> signingKey(const SignOptions& options) {
  const auto text = readText(options.keyFile, kLargestFile);
  if (!text) return text.problems();
  const auto keys = parseKeyFile(*text);
  if (!keys) return keys.problems();
  const auto key =
      std::find_if(keys->begin(), keys->end(), [&](const AccessKey& each) { return each.name == options.keyName; });
  if (key == keys->end()) {
    return Problem{ProblemCode::notFound, "--key", "The key file has no key of this name.", "", options.keyName};
  }
  if (key->signingSecrets.empty() || !allows(key->scope, Scope::render)) {
    return Problem{ProblemCode::forbidden, "--key", "This key can't sign: that takes a signingSecret and scope render.",
                   "", options.keyName};
  }
  return *key;
}

int runSign(const SignOptions& options) {
  const auto path = frameTargetBegin(options.url);
  if (!path) {
    return printProblems({invalidValue("URL", "This is no address of a frame without a fragment.",
                                       "[http://host:port]/v1/scenes/ID/frame?…", options.url)});
  }
  const auto key = signingKey(options);
  if (!key) return printProblems(key.problems());
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()).time_since_epoch();
  std::cout << options.url.substr(0, *path)
            << signedTarget(std::string_view(options.url).substr(*path), now.count() + options.seconds, key->name,
                            key->signingSecrets.front())
            << '\n';
  return kExitOk;
}

} // namespace

Subcommand addSignCommand(CLI::App& app) {
  auto options = std::make_shared<SignOptions>();
  auto* command = app.add_subcommand("sign", "Sign a frame's address, for a page that can't send a key");
  command->add_option("url", options->url, "The address of GET /v1/scenes/ID/frame, with its query")->required();
  command->add_option("--key-file", options->keyFile, "The server's key file; - = standard input")->required();
  command->add_option("--key", options->keyName, "The key that signs, by its first signingSecret")->required();
  const std::map<std::string, std::int64_t> units{{"s", 1}, {"m", 60}, {"h", 3'600}, {"d", 86'400}};
  constexpr std::int64_t kTenYears = 3'650ll * 86'400;
  command->add_option("--expires", options->seconds, "For how long it is valid: seconds, or as 30m, 12h, 7d")
      ->transform(CLI::AsNumberWithUnit(units))
      ->check(CLI::Range(std::int64_t{1}, kTenYears))
      ->required();
  return {[command] { return command->parsed(); }, [options] { return runSign(*options); }};
}

} // namespace gnomon::cli
