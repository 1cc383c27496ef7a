// Numbers and words in sentences for people.
#pragma once

#include <string>
#include <vector>

namespace palace {

/// printf with up to three numbers, of at most 199 characters.
std::string WithNumbers(const char* format, double a, double b = 0, double c = 0);

/// printf with one number; "-" where it is not finite.
std::string OrDash(const char* format, double value);
/// As short as ten digits allow: "0.5", "15.24", "1e+20". For what a person wrote, said back.
std::string NumberText(double value);

/// "640 x 480 px".
std::string SizeText(int width, int height);

/// "a, b, c".
std::string Joined(const std::vector<std::string>& words);

}  // namespace palace
