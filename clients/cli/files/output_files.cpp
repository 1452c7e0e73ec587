#include "clients/cli/files/output_files.h"

#include <filesystem>

#include "clients/cli/files/file_io.h"

namespace gnomon::cli {

std::optional<std::string> formatOf(const std::string& output) {
  const auto suffix = std::filesystem::path(output).extension();
  if (suffix == ".png") return "png";
  if (suffix == ".exr") return "exr";
  return std::nullopt;
}

std::string pictureFile(const std::string& output, const std::string& view, std::size_t pictureCount) {
  if (pictureCount == 1) return output;
  std::filesystem::path path(output);
  const std::string suffix = path.extension();
  return path.replace_extension(view + suffix);
}

Result<std::vector<std::string>> writePictures(const std::vector<Picture>& pictures, const std::string& output) {
  if (output == "-" && pictures.size() > 1) {
    return Problem{ProblemCode::invalidValue, "--output", "Standard output takes one picture.", "1",
                   std::to_string(pictures.size())};
  }
  std::vector<std::string> names;
  for (const Picture& picture : pictures) {
    names.push_back(pictureFile(output, picture.view, pictures.size()));
    if (auto written = writeFile(names.back(), picture.file); !written) return written.problems();
  }
  return names;
}

} // namespace gnomon::cli
