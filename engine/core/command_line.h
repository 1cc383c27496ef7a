// What a number on a command line may be, where CLI11's own checks let too much pass: its Range
// takes NaN, and its unsigned numbers wrap around.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/core/text.h"

namespace palace {

/// A number from `low` to `high`; NaN is none.
inline CLI::Validator FiniteRange(double low, double high) {
  const std::string limits = WithNumbers("%.10g to %.10g", low, high);
  return CLI::Validator(
      [low, high, limits](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && value >= low && value <= high ? std::string()
                                                       : text + " is not within " + limits;
      },
      limits);
}

/// A seed: digits that fit 64 bits.
inline CLI::Validator Seed() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t seed = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
        return error == std::errc() && end == text.data() + text.size()
                   ? std::string()
                   : text + " is no seed: a whole number from 0 to 18446744073709551615";
      },
      "");
}

}  // namespace palace
