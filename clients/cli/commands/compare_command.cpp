#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/compare/picture_difference.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/files/output_names.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

struct CompareOptions {
  std::string first, second;
  std::vector<std::string> layers; ///< NAME, or NAME=OTHER
  double threshold = 0;
  double share = 0;
  std::string diff; // a file, "-" = standard output, empty = none
};

Result<std::vector<ExrLayer>> readLayers(const std::string& path) {
  const auto file = readFile(path, kLimits.maxSceneBytes);
  if (!file) return file.problems();
  return decodePicture(*file, path);
}

/// What a pair of layers is called: "depth", "shadow=reference"; nothing where neither picture has layers.
std::string nameOf(const ExrLayer& first, const ExrLayer& second) {
  return first.name == second.name ? first.name : first.name + "=" + second.name;
}

/// One line a pair of layers, and their differences as pictures. Gives whether all are within the threshold.
Result<bool> compareLayers(const CompareOptions& options, std::span<const ExrLayer> first,
                           std::span<const ExrLayer> second) {
  const auto pairs = layerPairs(first, second, options.layers);
  if (!pairs) return pairs.problems();
  if (options.diff == "-" && pairs->size() > 1) {
    return invalidValue("--diff", "Standard output takes the difference of one layer.", "1",
                        std::to_string(pairs->size()));
  }
  bool isWithin = true;
  std::string lines;
  std::vector<Picture> pictures;
  for (const LayerPair& pair : *pairs) {
    const ExrLayer &ours = first[pair.first], &theirs = second[pair.second];
    const std::string name = nameOf(ours, theirs);
    const auto difference = differenceOf(ours.image, theirs.image, options.threshold);
    if (!difference) return name.empty() ? difference.problems() : about(name, difference.problems());
    lines += (name.empty() ? "" : printable(name) + ": ") + differenceText(*difference, options.threshold) + "\n";
    isWithin &= static_cast<double>(difference->beyond) <= options.share * static_cast<double>(difference->pixels);
    if (options.diff.empty()) continue;
    auto picture = differencePicture(ours.image, theirs.image, options.threshold);
    if (!picture) return picture.problems();
    pictures.push_back({asFileName(ours.name), *std::move(picture)});
  }
  if (!options.diff.empty()) {
    if (const auto names = writePictures(pictures, options.diff); !names) return names.problems();
  }
  if (options.diff != "-") std::cout << lines;
  return isWithin;
}

int runCompare(const CompareOptions& options) {
  const auto first = readLayers(options.first), second = readLayers(options.second);
  if (!first) return printProblems(first.problems());
  if (!second) return printProblems(second.problems());
  const bool isShare = std::holds_alternative<std::vector<std::uint8_t>>(first->front().image.pixels);
  if (isShare && options.threshold > 1) {
    printProblems({invalidValue("--threshold", "With 8 bits a channel, a share of their range.", "0..1",
                                std::to_string(options.threshold))});
    return kExitUsage;
  }
  const auto isWithin = compareLayers(options, *first, *second);
  if (!isWithin) return printProblems(isWithin.problems());
  return *isWithin ? kExitOk : kExitProblem;
}

} // namespace

Subcommand addCompareCommand(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  auto* command = app.add_subcommand("compare",
                                     "Report the difference of two pictures: exit code 0 within the threshold, "
                                     "else 1");
  command->add_option("first", options->first, "A PNG, JPEG, WebP or EXR file")->required();
  command->add_option("second", options->second, "Another of the same size, with the same layers")->required();
  command
      ->add_option("--threshold", options->threshold,
                   "Largest difference of a channel that passes: of 8 bits as a share of their range, 0.01 is one of "
                   "100; of an EXR's floats as it is, in linear light or metres")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--share", options->share, "Share of the pixels that may differ by more than the threshold")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--layer", options->layers,
                   "Compare only this layer of EXR files; with =OTHER, with that one of the second. Repeatable")
      ->type_name("NAME[=OTHER]")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--diff", options->diff,
                   "Write a PNG that shows where they differ, red beyond the threshold, of several layers one each, "
                   "diff.depth.png; - is standard output")
      ->type_name("FILE");
  return {[command] { return command->parsed(); }, [options] { return runCompare(*options); }};
}

} // namespace gnomon::cli
