#include "engine/core/plain_text.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(PlainText, IsPrintableAndBounded) {
  EXPECT_EQ(PlainText("alpha 1", 60), "alpha 1");
  EXPECT_EQ(PlainText("a\nb\x1b[31mc\x7f\xff", 60), "a?b?[31mc??");
  EXPECT_EQ(PlainText(std::string("a\0b", 3), 60), "a?b");
  EXPECT_EQ(PlainText(std::string(60, 'x'), 60), std::string(60, 'x'));
  EXPECT_EQ(PlainText(std::string(5000, 'x'), 60), std::string(57, 'x') + "...");
  EXPECT_EQ(QuotedText("al\"pha", 60), "\"al'pha\"");
  EXPECT_EQ(QuotedText("", 60), "\"\"");
}

}  // namespace
}  // namespace palace
