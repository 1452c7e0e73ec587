#include "clients/cli/files/request_files.h"

namespace gnomon::cli {

RequestFile environmentFile(const std::filesystem::path& file) {
  return {file.filename().string(), "/environment/file", "environment", file};
}

std::vector<RequestFile> requestFiles(const FrameSpec& spec, const std::optional<std::string>& environment) {
  std::vector<RequestFile> files;
  for (std::size_t i = 0; i < spec.volumes.size(); ++i) {
    files.push_back({spec.volumes[i].file, "/volumes/" + std::to_string(i) + "/file", "volume"});
  }
  if (!spec.environment.file) return files;
  const RequestFile given = environmentFile(environment.value_or(""));
  const RequestFile named{*spec.environment.file, given.pointer, given.what};
  files.push_back(given.name == named.name ? given : named); // a --set may have named another one after the flag
  return files;
}

std::vector<std::filesystem::path> placesOf(const std::vector<RequestFile>& files,
                                            const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> places;
  for (const RequestFile& file : files) {
    // What leads out of the scene's folder is refused later, and not looked at here.
    if (file.at) places.push_back(*file.at);
    if (!file.at && file.name.find("..") == std::string::npos) places.push_back(folder / file.name);
  }
  return places;
}

} // namespace gnomon::cli
