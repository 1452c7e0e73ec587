// Prints what each tone mapping makes of the same colors, as Markdown: by the text that both devices draw with.
//
// usage: bench_tones
#include <array>
#include <cmath>
#include <iostream>
#include <string>

#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

struct Named {
  const char* name;
  std::array<int, 3> bytes; ///< sRGB
};

constexpr std::array kColors{Named{"white, 1", {255, 255, 255}},    Named{"white, 0.9", {243, 243, 243}},
                             Named{"white, 0.8", {231, 231, 231}},  Named{"light skin", {236, 188, 160}},
                             Named{"dark skin", {112, 74, 56}},     Named{"red", {200, 20, 20}},
                             Named{"middle grey", {118, 118, 118}}, Named{"dark grey", {50, 50, 50}}};

struct Tone {
  const char* name;
  int tone;
};

constexpr std::array kTones{Tone{"none", GNOMON_TONE_CLIP}, Tone{"neutral", GNOMON_TONE_NEUTRAL},
                            Tone{"agx", GNOMON_TONE_AGX}, Tone{"aces", GNOMON_TONE_ACES}};

struct Lighting {
  const char* says;
  double brightness, reflected; ///< of what is seen: brightness * (color * (1 - reflected) + reflected)
};

constexpr std::array kLightings{Lighting{"A matt surface, lit so that it sends its own color", 1, 0},
                                Lighting{"A smooth surface in white surroundings, of which it mirrors 0.04", 1, 0.04},
                                Lighting{"The matt surface in twice the light", 2, 0}};

double decoded(int byte) {
  const double v = byte / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

int encoded(double linear) {
  return static_cast<int>(
      std::lround(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
}

glm::dvec3 linear(const std::array<int, 3>& bytes) {
  return {decoded(bytes[0]), decoded(bytes[1]), decoded(bytes[2])};
}

/// CIE L*a*b* of linear sRGB, white = 1.
glm::dvec3 lab(const glm::dvec3& rgb) {
  const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = root(dot(rgb, glm::dvec3(0.4124564, 0.3575761, 0.1804375)) / 0.95047);
  const double y = root(dot(rgb, glm::dvec3(0.2126729, 0.7151522, 0.0721750)));
  const double z = root(dot(rgb, glm::dvec3(0.0193339, 0.1191920, 0.9503041)) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

glm::dvec3 shown(const Lighting& light, const Tone& tone, const glm::dvec3& color) {
  const glm::dvec3 radiance = light.brightness * (color * (1 - light.reflected) + light.reflected);
  return glm::dvec3(shared::toneMapped(glm::vec3(radiance), tone.tone));
}

std::string bytesOf(const glm::dvec3& color) {
  return std::to_string(encoded(color.r)) + " " + std::to_string(encoded(color.g)) + " " +
         std::to_string(encoded(color.b));
}

void print(const Lighting& light) {
  std::cout << "\n" << light.says << ":\n\n| color | sRGB |";
  for (const Tone& tone : kTones) std::cout << " " << tone.name << " |";
  std::cout << "\n|---|---|---|---|---|---|\n";
  std::array<double, kTones.size()> sums{};
  for (const Named& color : kColors) {
    const glm::dvec3 wanted = linear(color.bytes);
    std::cout << "| " << color.name << " | " << bytesOf(wanted) << " |";
    for (std::size_t i = 0; i < kTones.size(); ++i) {
      const glm::dvec3 got = shown(light, kTones[i], wanted);
      const double off = glm::length(lab(got) - lab(wanted));
      sums[i] += off;
      std::cout << " " << bytesOf(got) << " (" << std::lround(off) << ") |";
    }
    std::cout << "\n";
  }
  std::cout << "| mean distance | |";
  for (const double sum : sums) std::cout << " " << std::round(10 * sum / kColors.size()) / 10 << " |";
  std::cout << "\n";
}

void printAll() {
  std::cout
      << "<!-- readme -->\nIn brackets: the distance to the color itself in CIE L\\*a\\*b\\* (1976); 2 is just seen.\n";
  for (const Lighting& light : kLightings) print(light);
  std::cout << "<!-- /readme -->\n";
}

} // namespace
} // namespace gnomon

int main() {
  gnomon::printAll();
}
