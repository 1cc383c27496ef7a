// Letters of sites on a map: none covers another, the best keeps its place, none jumps.
#include "gui/widgets/map/letter_places.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr Rect kMap{100, 50, 400, 400};
const ImVec2 kHalf{11, 11};

bool Cover(const LetterPlace& a, const LetterPlace& b) {
  const ImVec2 p = a.centre(), q = b.centre();
  return std::abs(p.x - q.x) < a.half.x + b.half.x && std::abs(p.y - q.y) < a.half.y + b.half.y;
}

void ExpectApart(const std::vector<LetterPlace>& letters) {
  for (std::size_t i = 0; i < letters.size(); ++i) {
    for (std::size_t j = i + 1; j < letters.size(); ++j) {
      EXPECT_FALSE(Cover(letters[i], letters[j])) << i << " and " << j;
    }
    const ImVec2 p = letters[i].centre();
    EXPECT_TRUE(p.x >= kMap.x + 11 && p.x <= kMap.right() - 11 && p.y >= kMap.y + 11 &&
                p.y <= kMap.bottom() - 11)
        << i;
  }
}

TEST(LetterPlaces, ThatAreApartStayWhereTheyAre) {
  std::vector<LetterPlace> letters = {{1, {200, 200}, kHalf}, {2, {230, 200}, kHalf}};
  SpreadLetters(letters, {}, kMap);
  for (const LetterPlace& letter : letters) {
    EXPECT_FALSE(letter.moved);
    EXPECT_EQ(letter.centre().x, letter.anchor.x);
  }
}

TEST(LetterPlaces, OfOnePlaceAreSpreadAndTheBestKeepsIt) {
  std::vector<LetterPlace> letters;
  for (std::uint64_t id = 1; id <= 12; ++id) {
    letters.push_back({id, {300, 250}, kHalf});
  }
  SpreadLetters(letters, {}, kMap);
  ExpectApart(letters);
  EXPECT_FALSE(letters[0].moved);
  EXPECT_TRUE(letters[1].moved);
}

TEST(LetterPlaces, AreSpreadWhereverTheSitesLie) {
  RandomStream random(5);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const double across = random.Uniform(5, 150);
    std::vector<LetterPlace> letters;
    for (std::uint64_t id = 1; id <= 10; ++id) {
      const ImVec2 at{static_cast<float>(110 + random.Uniform(0, across)),
                      static_cast<float>(60 + random.Uniform(0, across))};
      letters.push_back({id, at, kHalf});
    }
    SpreadLetters(letters, {}, kMap);
    ExpectApart(letters);
  }
}

TEST(LetterPlaces, DoNotJumpWhereTheirSitesTremble) {
  std::vector<LetterPlace> last;
  RandomStream random(7);
  ImVec2 stood{};
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<LetterPlace> letters;
    for (std::uint64_t id = 1; id <= 5; ++id) {
      const auto x = static_cast<float>(300 + 4 * static_cast<double>(id) + random.Uniform(-1, 1));
      letters.push_back({id, {x, static_cast<float>(250 + random.Uniform(-1, 1))}, kHalf});
    }
    SpreadLetters(letters, last, kMap);
    if (frame > 0) {
      EXPECT_LT(std::hypot(letters[4].centre().x - stood.x, letters[4].centre().y - stood.y), 3);
    }
    stood = letters[4].centre();
    last = letters;
  }
}

TEST(LetterPlaces, GoBackOnceTheirPlaceIsFree) {
  std::vector<LetterPlace> letters = {{1, {300, 250}, kHalf}, {2, {310, 250}, kHalf}};
  SpreadLetters(letters, {}, kMap);
  ASSERT_TRUE(letters[1].moved);
  std::vector<LetterPlace> alone = {{2, {310, 250}, kHalf}};
  SpreadLetters(alone, letters, kMap);
  EXPECT_FALSE(alone[0].moved);
}

}  // namespace
}  // namespace palace
