#include "server/scenes/folder_names.h"

#include <dirent.h>
#include <memory>
#include <string_view>

namespace gnomon {

void eachName(const std::string& folder, const std::function<void(std::string_view name)>& visit) {
  const auto close = [](DIR* open) { ::closedir(open); };
  const std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.c_str()), close);
  if (!open) return;
  while (const dirent* entry = ::readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") visit(name);
  }
}

} // namespace gnomon
