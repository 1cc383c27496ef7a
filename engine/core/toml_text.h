// TOML text to a table. toml++ 3.3 runs into undefined behaviour at letters outside ASCII where a
// key or a bare value may stand, broken texts included; inside strings and comments any are fine.
// So a text is parsed with an ASCII letter in the place of each other one first: what is no TOML
// ends there, and in what is TOML it is known where strings and comments are.
#pragma once

#define TOML_EXCEPTIONS 0
// toml++ 3.3 asserts that a table header starts with a key ("[?]" in a damaged file aborts), but
// reports the same as an error two lines later. Files are input: never abort on them.
#define TOML_ASSERT(expr) static_assert(true)

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "engine/core/result.h"

namespace palace {

/// kInvalid with `name` and line for what is no TOML, and for a letter outside ASCII outside of
/// strings and comments.
Result<toml::table> ParseToml(std::string_view text, const std::string& name);

/// A number of the file. Nothing for what is no number. A whole number that no double holds exactly
/// (beyond 2^53, of which toml++'s own value<double>() tells nothing) is the nearest one.
std::optional<double> NumberOfToml(const toml::node& node);

}  // namespace palace
