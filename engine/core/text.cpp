#include "engine/core/text.h"

#include <cmath>
#include <cstdio>

namespace palace {

std::string WithNumbers(const char* format, double a, double b, double c) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

std::string OrDash(const char* format, double value) {
  return std::isfinite(value) ? WithNumbers(format, value) : "-";
}

std::string NumberText(double value) { return WithNumbers("%.10g", value); }

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

}  // namespace palace
