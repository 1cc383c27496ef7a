// Letters that toml++ cannot look at are refused before it sees them.
#include "engine/core/toml_text.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

// toml++ tells no double of a whole number that none holds exactly.
TEST(TomlText, NumbersAreToldHoweverLargeTheyAre) {
  const toml::table table = *ParseToml(
      "a = 9007199254740993\nb = -9223372036854775807\nc = 3\nd = 2.5\ne = \"3\"\nf = true", "t");
  EXPECT_EQ(NumberOfToml(*table.get("a")), 9007199254740992.0);
  EXPECT_EQ(NumberOfToml(*table.get("b")), -9223372036854775808.0);
  EXPECT_EQ(NumberOfToml(*table.get("c")), 3.0);
  EXPECT_EQ(NumberOfToml(*table.get("d")), 2.5);
  EXPECT_FALSE(NumberOfToml(*table.get("e")));
  EXPECT_FALSE(NumberOfToml(*table.get("f")));
}

TEST(TomlText, LettersOutsideAsciiAreRefusedWhereKeysStand) {
  struct Row {
    const char* text;
    const char* line;  ///< null: fine
  };
  const Row rows[] = {
      {"", nullptr},
      {"a = 1\n[b]\nc = \"d\"\n", nullptr},
      {"k\xc3\xa4y = 1", "1"},
      {"a = 1\n[s\xc3\xa4]\n", "2"},
      {"a = 1\n\na = {\xc3\xa4 = 1}", "3"},
      {"a = \xc3\xa4", "1"},
      {"\xff", "1"},
      {"\xef\xbb\xbf"
       "a = 1",
       nullptr},
      {"a = 1 # \xc3\xa4", nullptr},
      {"# \xc3\xa4\n\xc3\xa4 = 1", "2"},
      {"a = \"\xc3\xa4\"", nullptr},
      {"a = '\xc3\xa4'", nullptr},
      {"\"\xc3\xa4\" = 1", nullptr},
      {"a = \"\\\"\xc3\xa4\" # \xc3\xa4\nb\xc3\xa4 = 1", "2"},
      {"a = '\\'\xc3\xa4 = 1", "1"},
      {"a = \"\"\"\n\xc3\xa4 \"\" \n\"\"\"\"\"\nb\xc3\xa4 = 1", "4"},
      {"a = '''\xc3\xa4\n'''\nb\xc3\xa4 = 1", "3"},
      {"a = \"\"\n\xc3\xa4 = 1", "2"},
      {"a = \"open\n\xc3\xa4 = 1", "1"},
      {"a = 0\"\xc3\xa4\"", "1"},  // amid a bare word a quote begins nothing
      {"a = [\"\xc3\xa4\", '\xc3\xa4']", nullptr},
      {"a.\"\xc3\xa4\" = { \"\xc3\xa4\" = \"\xc3\xa4\" }", nullptr},
      {"\xef\xbb\xbf\"\xc3\xa4\" = 1", nullptr},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.text);
    const Result<toml::table> table = ParseToml(row.text, "x.toml");
    EXPECT_EQ(table.ok(), row.line == nullptr) << (table.ok() ? "" : table.error().message);
    if (row.line != nullptr && !table.ok()) {
      EXPECT_EQ(table.error().message.find(std::string("x.toml:") + row.line + ": "), 0u)
          << table.error().message;
    }
  }
}

}  // namespace
}  // namespace palace
