#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/evaluation/evaluation.h"

namespace gnomon::bench {

/// What the variants of one evaluation reached over many scenes. The first variant is what times are held against.
class AccuracySums {
 public:
  explicit AccuracySums(const std::vector<Variant>& variants);

  /// Left out where the first variant could not be measured, or no pixel is a receiver.
  void add(const std::string& scene, const std::vector<EvaluationRow>& rows);

  std::size_t scenes() const { return names_.size(); }

  /// One row a variant: the share over all receivers, and as `milliseconds` the median multiple of the first's time.
  EvaluationReport report() const;
  /// The same as Markdown, with displacements; `all` is that report, its Pareto front marked.
  std::string table(const EvaluationReport& all) const;
  /// Of the first variant: each scene's error, and its displacement beside the predicted one.
  std::string sceneTable() const;

 private:
  struct Sum {
    std::string name;
    double receivers = 0;
    double wrong = 0;
    double falseShadow = 0;
    double falseLit = 0;
    double interior = 0;
    double worst = 0; ///< largest share of a scene
    std::vector<double> ratios;
    std::vector<double> displacements;
    std::size_t refused = 0;
  };
  struct First {
    double misclassified = 0;
    std::optional<double> displacement{};
    std::optional<double> predicted{};
    std::optional<double> texels{};
  };

  std::vector<Sum> sums_;
  std::vector<std::string> names_;
  std::vector<First> firsts_;
};

} // namespace gnomon::bench
