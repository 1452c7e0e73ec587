#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace gnomon {

/// Calls with the name of each entry of a folder, in no order, `.` and `..` left out. What appears or goes meanwhile
/// may be among them or not. Nothing where the folder can't be read.
void eachName(const std::string& folder, const std::function<void(std::string_view name)>& visit);

} // namespace gnomon
