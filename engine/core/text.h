// Numbers and words in sentences for people.
#pragma once

#include <string>
#include <vector>

namespace palace {

/// printf with up to three numbers, of at most 199 characters.
std::string WithNumbers(const char* format, double a, double b = 0, double c = 0);

/// "a, b, c".
std::string Joined(const std::vector<std::string>& words);

}  // namespace palace
