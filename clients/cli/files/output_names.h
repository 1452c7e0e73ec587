#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/cli/render/rendering.h"
#include "protocol/base/result.h"

/// Names of files that are made from a pattern, "out/{scene}-{camera}.png", and the pictures in them.
namespace gnomon::cli {

/// Placeholder without its braces -> its value.
using Placeholders = std::map<std::string, std::string>;

/// What a client or a scene calls something, as a part of a file's name.
std::string asFileName(std::string name);

/// The pattern with every {placeholder} of `values` filled in; {view}, which is filled in when the pictures are there,
/// stays. Problems: a placeholder that there is none of here.
Result<std::string> filledIn(const std::string& pattern, const Placeholders& values);

/// Of a path its name without its suffix; of "-" stdin.
std::string sceneName(const std::string& path);

/// A number with leading zeros, for names that sort: 7 -> "00007".
std::string frameNumber(int index);

/// The `output.format` of the name's suffix; nothing for any other, and for "-" (standard output).
std::optional<std::string> formatOf(const std::string& output);

/// Every suffix that formatOf knows: ".png .exr ...".
std::string suffixList();

/// What is wrong with an output's name: empty where formatOf knows it.
std::string checkPictureName(const std::string& output);

/// Where a picture goes: the output with its {view}, the output itself, or, one of several, "frame.depth.png" for view
/// depth of "frame.png".
std::string pictureFile(const std::string& output, const std::string& view, std::size_t pictureCount);

/// Writes every picture, each file in one step; gives their names. Standard output takes one picture only.
Result<std::vector<std::string>> writePictures(const std::vector<Picture>& pictures, const std::string& output);

/// Every camera of every scene.
struct BatchOrder {
  std::vector<std::string> scenes;
  std::vector<std::string> cameras; ///< empty = as the request says
  std::string output, report;       ///< patterns; an empty report is none
};

struct BatchItem {
  std::string scene;
  std::optional<std::string> camera;
  std::string output, report;
  std::optional<Problem> collision; ///< it would write a file that one before it writes: it is not to be made
};

/// The pictures to make, scene by scene. {scene} is a scene's name, {folder} that of its folder, {camera} the flag's
/// value, or "default" without one. Problems: a name that is the same for all, where there are several.
Result<std::vector<BatchItem>> batchItems(const BatchOrder& order);

} // namespace gnomon::cli
