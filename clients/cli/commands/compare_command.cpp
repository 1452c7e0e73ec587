#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "clients/cli/commands/commands.h"
#include "clients/cli/compare/picture_difference.h"
#include "clients/cli/files/file_io.h"
#include "clients/cli/terminal/messages.h"
#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

struct CompareOptions {
  std::string first, second;
  double threshold = 0;
  double share = 0;
  std::string diff; // a file, "-" = standard output, empty = none
};

Result<Image> readPicture(const std::string& path) {
  const auto file = readFile(path, kLimits.maxSceneBytes);
  if (!file) return file.problems();
  return decodePicture(*file, path);
}

int runCompare(const CompareOptions& options) {
  const auto first = readPicture(options.first), second = readPicture(options.second);
  if (!first) return printProblems(first.problems());
  if (!second) return printProblems(second.problems());
  const auto difference = differenceOf(*first, *second, options.threshold);
  if (!difference) return printProblems(difference.problems());
  if (!options.diff.empty()) {
    const auto picture = differencePicture(*first, *second, options.threshold);
    if (!picture) return printProblems(picture.problems());
    if (const Status written = writeFile(options.diff, *picture); !written) return printProblems(written.problems());
  }
  if (options.diff != "-") std::cout << differenceText(*difference, options.threshold) << '\n';
  const double share = static_cast<double>(difference->beyond) / static_cast<double>(difference->pixels);
  return share > options.share ? kExitProblem : kExitOk;
}

} // namespace

Subcommand addCompareCommand(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  auto* command = app.add_subcommand("compare",
                                     "Tell how far two pictures are apart: exit code 0 within the threshold, "
                                     "else 1");
  command->add_option("first", options->first, "A PNG, JPEG or WebP file")->required();
  command->add_option("second", options->second, "Another of the same size")->required();
  command
      ->add_option("--threshold", options->threshold,
                   "Largest difference of a channel that passes, as a share of its range: 0.01 is one of 100")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--share", options->share, "Share of the pixels that may differ by more than the threshold")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--diff", options->diff,
                   "Write a PNG that shows where they differ, red beyond the threshold; - is standard output")
      ->type_name("FILE");
  return {[command] { return command->parsed(); }, [options] { return runCompare(*options); }};
}

} // namespace gnomon::cli
