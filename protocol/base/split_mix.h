#pragma once

#include <cstdint>

/// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
namespace gnomon {

/// Its finaliser: every bit of the result depends on every bit of `x`. No two numbers give the same; 0 stays 0.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// The number that the generator gives from the state `x`.
constexpr std::uint64_t splitMix64(std::uint64_t x) {
  return mixed(x + 0x9e3779b97f4a7c15u);
}

} // namespace gnomon
