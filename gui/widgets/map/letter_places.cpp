#include "gui/widgets/map/letter_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace palace {
namespace {

constexpr int kDirections = 16, kRings = 12;
constexpr float kGap_px = 5;  // sites tremble by a pixel or two from map to map

/// No overlap with those placed before, with so much room round it.
bool IsFree(const LetterPlace& letter, ImVec2 shift, std::span<const LetterPlace> placed,
            float room) {
  const ImVec2 at{letter.anchor.x + shift.x, letter.anchor.y + shift.y};
  return std::none_of(placed.begin(), placed.end(), [&](const LetterPlace& other) {
    const ImVec2 there = other.centre();
    return std::abs(at.x - there.x) < letter.half.x + other.half.x + room &&
           std::abs(at.y - there.y) < letter.half.y + other.half.y + room;
  });
}

bool IsWithin(const LetterPlace& letter, ImVec2 shift, const Rect& within) {
  const ImVec2 at{letter.anchor.x + shift.x, letter.anchor.y + shift.y};
  return at.x - letter.half.x >= within.x && at.x + letter.half.x <= within.right() &&
         at.y - letter.half.y >= within.y && at.y + letter.half.y <= within.bottom();
}

const LetterPlace* Before(const std::vector<LetterPlace>& last, std::uint64_t site) {
  const auto found = std::find_if(last.begin(), last.end(),
                                  [&](const LetterPlace& one) { return one.site == site; });
  return found != last.end() ? &*found : nullptr;
}

/// The first free step: rings outwards, each from where the neighbours' middle is not.
ImVec2 FirstFree(const LetterPlace& letter, std::span<const LetterPlace> placed, const Rect& within,
                 double from_rad) {
  const float step = std::max(letter.half.x, letter.half.y);
  for (int ring = 0; ring < kRings; ++ring) {
    const float radius = static_cast<float>(2 + ring) * step + kGap_px;
    for (int k = 0; k < kDirections; ++k) {
      const int side = k % 2 == 0 ? k / 2 : -(k + 1) / 2;  // to either side in turn
      const double angle = from_rad + 2 * std::numbers::pi * side / kDirections;
      const ImVec2 shift{radius * static_cast<float>(std::cos(angle)),
                         radius * static_cast<float>(std::sin(angle))};
      if (IsWithin(letter, shift, within) && IsFree(letter, shift, placed, kGap_px)) {
        return shift;
      }
    }
  }
  return {};
}

ImVec2 Middle(const std::vector<LetterPlace>& letters) {
  ImVec2 sum{};
  for (const LetterPlace& letter : letters) {
    sum = {sum.x + letter.anchor.x, sum.y + letter.anchor.y};
  }
  const auto count = static_cast<float>(std::max<std::size_t>(1, letters.size()));
  return {sum.x / count, sum.y / count};
}

}  // namespace

void SpreadLetters(std::vector<LetterPlace>& letters, const std::vector<LetterPlace>& last,
                   const Rect& within) {
  const ImVec2 middle = Middle(letters);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    LetterPlace& letter = letters[i];
    const std::span<const LetterPlace> placed(letters.data(), i);
    const LetterPlace* before = Before(last, letter.site);
    const bool was_moved = before != nullptr && before->moved;
    const float room = was_moved ? letter.half.y : 0;
    letter.shift = {};
    if (IsWithin(letter, {}, within) && IsFree(letter, {}, placed, room)) {
      letter.moved = false;
      continue;
    }
    if (was_moved && IsWithin(letter, before->shift, within) &&
        IsFree(letter, before->shift, placed, 0)) {
      letter.shift = before->shift;
    } else {
      const float x = letter.anchor.x - middle.x, y = letter.anchor.y - middle.y;
      const bool apart = std::hypot(x, y) > 1;
      const double away = apart ? std::atan2(static_cast<double>(y), static_cast<double>(x)) : 0;
      letter.shift = FirstFree(letter, placed, within, away);
    }
    letter.moved = letter.shift.x != 0 || letter.shift.y != 0;
  }
}

ImVec2 CornerOfRing(const LetterPlace& letter, ImVec2 beside, std::span<const LetterPlace> others,
                    const Rect& within) {
  const auto kept = [](float at, float low, float high) {
    return std::clamp(at, low, std::max(low, high));
  };
  std::optional<ImVec2> first;
  for (const ImVec2 side : {ImVec2{1, -1}, ImVec2{-1, -1}, ImVec2{1, 1}, ImVec2{-1, 1}}) {
    const ImVec2 at{kept(letter.anchor.x + side.x * beside.x, within.x + letter.half.x,
                         within.right() - letter.half.x),
                    kept(letter.anchor.y + side.y * beside.y, within.y + letter.half.y,
                         within.bottom() - letter.half.y)};
    if (IsFree(letter, {at.x - letter.anchor.x, at.y - letter.anchor.y}, others, 0)) {
      return at;
    }
    first = first.value_or(at);
  }
  return *first;
}

}  // namespace palace
