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

TEST(PlainText, PrintableKeepsLettersAndShowsWhatATerminalMayObey) {
  for (const char* kept :
       {"", "plain, 1.5", "Höhe \xC3\xBC\xE2\x82\xAC \xF0\x9F\x9A\x81", "a\\x1B"}) {
    EXPECT_EQ(Printable(kept), kept);
  }
  const struct {
    std::string text;
    const char* shown;
  } rows[] = {
      {"a\x1b[2Jb", "a\\x1B[2Jb"},
      {"tab\t line\n\r\x7f", "tab\\x09 line\\x0A\\x0D\\x7F"},
      {std::string("a\0b", 3), "a\\x00b"},
      {"\x9b"
       "31m",
       "\\x9B31m"},  // an 8-bit terminal's ESC [
      {"\xC2\x9b"
       "31m",
       "\\xC2\\x9B31m"},  // the same in UTF-8
      {"cut \xE2\x82", "cut \\xE2\\x82"},
      {"\xC0\xAF \xED\xA0\x80 \xF5", "\\xC0\\xAF \\xED\\xA0\\x80 \\xF5"},  // too long, half, none
  };
  for (const auto& row : rows) {
    EXPECT_EQ(Printable(row.text), row.shown);
  }
}

}  // namespace
}  // namespace palace
