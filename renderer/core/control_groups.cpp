#include "renderer/core/control_groups.h"

#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::string contentsOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether `names`, separated by commas, has `name`.
bool lists(std::string_view names, std::string_view name) {
  std::istringstream all{std::string(names)};
  for (std::string each; std::getline(all, each, ',');) {
    if (each == name) return true;
  }
  return false;
}

/// Without the escapes of proc(5): "\040" is a space.
fs::path unescaped(std::string_view text) {
  const auto isOctal = [](char digit) { return digit >= '0' && digit <= '7'; };
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool isEscape =
        text[i] == '\\' && i + 3 < text.size() && isOctal(text[i + 1]) && isOctal(text[i + 2]) && isOctal(text[i + 3]);
    if (!isEscape) {
      path += text[i];
      continue;
    }
    path += static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
    i += 3;
  }
  return path;
}

/// Where control groups of one hierarchy can be seen.
struct Mount {
  bool unified = false;    ///< version 2
  std::string controllers; ///< of version 1, among other words
  fs::path top;            ///< the group that is mounted
  fs::path at;
};

/// "36 31 0:33 /top /at rw shared:1 - cgroup name rw,memory"
std::optional<Mount> mountOf(const std::string& line) {
  std::istringstream words(line);
  std::string ignored, top, at, word, type, source, options;
  words >> ignored >> ignored >> ignored >> top >> at;
  while (words >> word && word != "-") {
  }
  if (!(words >> type >> source >> options) || (type != "cgroup" && type != "cgroup2")) return std::nullopt;
  return Mount{type == "cgroup2", options, unescaped(top), unescaped(at)};
}

/// The folder of a mount's top, and those of the groups from there down to `own`.
void addGroups(std::vector<fs::path>& groups, const Mount& mount, const fs::path& own) {
  fs::path folder = mount.at;
  groups.push_back(folder);
  const fs::path below = own.lexically_relative(mount.top);
  if (below.empty() || below == "." || *below.begin() == "..") return;
  for (const fs::path& name : below) groups.push_back(folder /= name);
}

} // namespace

std::vector<fs::path> controlGroups(std::string_view controller, const std::string& membership,
                                    const std::string& mounts) {
  std::vector<fs::path> groups;
  std::istringstream mountLines(mounts);
  for (std::string mountLine; std::getline(mountLines, mountLine);) {
    const auto mount = mountOf(mountLine);
    if (!mount || (!mount->unified && !lists(mount->controllers, controller))) continue;
    std::istringstream lines(membership);
    for (std::string line; std::getline(lines, line);) { // "0::/own" of version 2, "4:cpu,cpuacct:/own" of version 1
      const std::size_t names = line.find(':');
      const std::size_t own = line.find(':', names + 1);
      if (names == std::string::npos || own == std::string::npos) continue;
      const std::string_view listed = std::string_view(line).substr(names + 1, own - names - 1);
      if (mount->unified ? listed.empty() : lists(listed, controller)) addGroups(groups, *mount, line.substr(own + 1));
    }
  }
  return groups;
}

std::vector<fs::path> controlGroups(std::string_view controller) {
  return controlGroups(controller, contentsOf("/proc/self/cgroup"), contentsOf("/proc/self/mountinfo"));
}

} // namespace gnomon
