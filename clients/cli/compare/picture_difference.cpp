#include "clients/cli/compare/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <variant>

#include "protocol/spec/limits.h"

namespace gnomon::cli {
namespace {

double distance(std::uint8_t a, std::uint8_t b) {
  return std::abs(int(a) - int(b)) / 255.0;
}

double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double difference = std::abs(double(a) - double(b));
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

std::size_t pixelCount(const Image& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

template <class Number>
std::vector<double> pixelDifferences(const Image& a, const Image& b) {
  const auto& ours = std::get<std::vector<Number>>(a.pixels);
  const auto& theirs = std::get<std::vector<Number>>(b.pixels);
  const std::size_t channels = a.channels.size();
  std::vector<double> differences(pixelCount(a), 0);
  for (std::size_t at = 0; at < ours.size(); ++at) {
    double& largest = differences[at / channels];
    largest = std::max(largest, distance(ours[at], theirs[at]));
  }
  return differences;
}

bool isFloat(const Image& picture) {
  return std::holds_alternative<std::vector<float>>(picture.pixels);
}

/// Row by row.
std::vector<double> pixelDifferences(const Image& a, const Image& b) {
  return isFloat(a) ? pixelDifferences<float>(a, b) : pixelDifferences<std::uint8_t>(a, b);
}

std::string sizeText(const Image& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

std::string channelText(const Image& picture) {
  std::string text;
  for (const std::string& channel : picture.channels) text += (text.empty() ? "" : ",") + channel;
  return text;
}

std::string kindText(const Image& picture) {
  return isFloat(picture) ? "linear floats" : "8 bits a channel";
}

/// The layers of this name, or of both names of NAME=OTHER. `flag` is what asks for them; empty = every layer is
/// compared.
Result<LayerPair> pairOf(std::span<const ExrLayer> first, std::span<const ExrLayer> second, const std::string& asked,
                         const std::string& flag) {
  const auto equals = flag.empty() ? std::string::npos : asked.find('=');
  const std::string ours = asked.substr(0, equals);
  const std::string theirs = equals == std::string::npos ? ours : asked.substr(equals + 1);
  const auto place = [&](std::span<const ExrLayer> layers, const std::string& name,
                         const std::string& which) -> Result<std::size_t> {
    std::string names;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (layers[i].name == name) return i;
      names += (names.empty() ? "" : ", ") + layers[i].name;
    }
    return Problem{ProblemCode::notFound, flag, "The " + which + " picture has no such layer.", names, name};
  };
  const auto here = place(first, ours, "first"), there = place(second, theirs, "second");
  if (!here) return here.problems();
  if (!there) return there.problems();
  return LayerPair{*here, *there};
}

} // namespace

Result<std::vector<ExrLayer>> decodePicture(std::span<const std::uint8_t> file, const std::string& name) {
  const auto named = [&](Problems problems) {
    for (Problem& problem : problems) problem.pointer = name;
    return problems;
  };
  if (isExr(file)) {
    auto layers = decodeExr(file, kLimits.maxFrameSide, 16 * kLimits.maxFramePixels);
    if (!layers) return named(layers.problems());
    const auto isColor = [](const ExrLayer& layer) { return layer.name == "color"; };
    if (std::none_of(layers->begin(), layers->end(), isColor)) {
      for (ExrLayer& layer : *layers) layer.name = layer.name == "main" ? "color" : layer.name;
    }
    return layers;
  }
  auto picture = decodeImage(file, kLimits.maxFrameSide, kLimits.maxFramePixels);
  if (!picture) return named(picture.problems());
  return std::vector{ExrLayer{"", *std::move(picture)}};
}

Result<std::vector<LayerPair>> layerPairs(std::span<const ExrLayer> first, std::span<const ExrLayer> second,
                                          std::span<const std::string> asked) {
  if (asked.empty() && first.size() == 1 && second.size() == 1) return std::vector{LayerPair{0, 0}};
  std::vector<std::string> wanted(asked.begin(), asked.end());
  for (std::size_t i = 0; asked.empty() && i < std::max(first.size(), second.size()); ++i) {
    if (i < first.size()) wanted.push_back(first[i].name);
    // What only the second one has is a difference, too.
    if (i < second.size() &&
        std::none_of(first.begin(), first.end(), [&](const ExrLayer& each) { return each.name == second[i].name; })) {
      wanted.push_back(second[i].name);
    }
  }
  std::vector<LayerPair> pairs;
  Problems problems;
  for (const std::string& each : wanted) {
    const auto pair = pairOf(first, second, each, asked.empty() ? "" : "--layer");
    if (pair) pairs.push_back(*pair);
    if (!pair) problems.insert(problems.end(), pair.problems().begin(), pair.problems().end());
  }
  if (!problems.empty()) return problems;
  return pairs;
}

Result<PictureDifference> differenceOf(const Image& a, const Image& b, double threshold) {
  for (const auto& [differs, ours, theirs, says] :
       {std::tuple(isFloat(a) != isFloat(b), kindText(a), kindText(b), "The pictures differ in kind."),
        std::tuple(a.width != b.width || a.height != b.height, sizeText(a), sizeText(b),
                   "The pictures differ in size."),
        std::tuple(a.channels != b.channels, channelText(a), channelText(b), "The pictures differ in channels.")}) {
    if (differs) return invalidValue("", says, ours, theirs);
  }
  const std::vector<double> differences = pixelDifferences(a, b);
  const auto worst = std::max_element(differences.begin(), differences.end());
  const auto at = static_cast<std::size_t>(worst - differences.begin()), width = static_cast<std::size_t>(a.width);
  PictureDifference result;
  result.largest = *worst;
  result.pixels = static_cast<std::int64_t>(differences.size());
  result.worstX = static_cast<int>(at % width);
  result.worstY = static_cast<int>(at / width);
  double sum = 0;
  for (const double difference : differences) {
    sum += difference;
    result.beyond += difference > threshold;
  }
  result.mean = sum / static_cast<double>(result.pixels);
  return result;
}

Result<Bytes> differencePicture(const Image& a, const Image& b, double threshold) {
  const std::vector<double> differences = pixelDifferences(a, b);
  double largest = 0;
  for (const double difference : differences) {
    if (std::isfinite(difference)) largest = std::max(largest, difference);
  }
  std::vector<std::uint8_t> pixels;
  pixels.reserve(differences.size() * 3);
  for (const double difference : differences) {
    const double share = largest > 0 ? std::min(difference / largest, 1.0) : difference > 0 ? 1.0 : 0.0;
    const auto level = static_cast<std::uint8_t>(share * 255);
    const bool isBeyond = difference > threshold;
    // Never darker than what can be seen: one level off counts, too.
    const auto red = isBeyond ? std::max<std::uint8_t>(level, 96) : level;
    const std::uint8_t rest = isBeyond ? 0 : level;
    pixels.insert(pixels.end(), {red, rest, rest});
  }
  return encodePng(Image{a.width, a.height, {"R", "G", "B"}, std::move(pixels)}, 2);
}

std::string differenceText(const PictureDifference& difference, double threshold) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "largest %.4g at %d,%d, mean %.4g, beyond %g: %lld of %lld pixels",
                difference.largest, difference.worstX, difference.worstY, difference.mean, threshold,
                static_cast<long long>(difference.beyond), static_cast<long long>(difference.pixels));
  return text.data();
}

} // namespace gnomon::cli
