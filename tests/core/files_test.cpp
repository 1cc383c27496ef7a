// Files are read whole, and written whole or not at all.
#include "engine/core/files.h"

#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() { fs::remove_all(folder_); }
  ~Files() override { fs::remove_all(folder_); }
  std::string Text(const fs::path& path) const {
    std::ifstream file(path, std::ios::binary);
    return (std::stringstream() << file.rdbuf()).str();
  }
  const fs::path folder_ = OwnPath();
};

TEST_F(Files, ATextReplacesTheOneBeforeAndLeavesNothingElse) {
  ASSERT_TRUE(MakeFolder(folder_ / "deep" / "down").ok());
  ASSERT_TRUE(MakeFolder(folder_ / "deep" / "down").ok()) << "there already";
  const fs::path path = folder_ / "deep/down/a.txt";
  const std::string second("two\0lines\r\n", 11);
  ASSERT_TRUE(WriteTextFile(path, "a first text, longer than the second").ok());
  ASSERT_TRUE(WriteTextFile(path, second).ok());
  EXPECT_EQ(Text(path), second);
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST_F(Files, ATextIsReadToTheLastByteAndNoLongerOneThanTheLimit) {
  ASSERT_TRUE(MakeFolder(folder_).ok());
  const std::string text("two\0lines\r\n", 11);
  ASSERT_TRUE(WriteTextFile(folder_ / "a.txt", text).ok());
  const Result<std::string> read = ReadTextFile(folder_ / "a.txt", text.size());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(*read, text);
  const struct {
    fs::path path;
    ErrorCode code;
    const char* said;
  } rows[] = {{folder_ / "a.txt", ErrorCode::kInvalid, "a.txt: 11 bytes, larger than 10 bytes"},
              {folder_, ErrorCode::kUnavailable, "is a folder"},
              {folder_ / "b.txt", ErrorCode::kUnavailable, "b.txt: no such file"},
              {"/dev/zero", ErrorCode::kUnavailable, "is no file on disk"}};
  for (const auto& row : rows) {
    const Result<std::string> refused = ReadTextFile(row.path, 10);
    ASSERT_FALSE(refused.ok()) << row.path;
    EXPECT_EQ(refused.error().code, row.code) << row.path;
    EXPECT_NE(refused.error().message.find(row.said), std::string::npos) << refused.error().message;
  }
}

TEST_F(Files, APipeOrADeviceIsNoFileOnDisk) {
  ASSERT_TRUE(MakeFolder(folder_).ok());
  ASSERT_TRUE(WriteTextFile(folder_ / "a.txt", "").ok());
  EXPECT_TRUE(CheckRegularFile(folder_ / "a.txt").ok());
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {folder_ / "pipe", fs::path("/dev/zero"), fs::path("-")}) {
    const Status refused = CheckRegularFile(path);
    ASSERT_FALSE(refused.ok()) << path;
    EXPECT_EQ(refused.error().message.find(path.string() + ": is no file on disk; save "), 0u)
        << refused.error().message;
  }
}

TEST_F(Files, WhatCannotBeWrittenIsNamedAndKeepsItsOldText) {
  ASSERT_TRUE(MakeFolder(folder_).ok());
  ASSERT_TRUE(WriteTextFile(folder_ / "file", "old").ok());
  const Status in_a_file = WriteTextFile(folder_ / "file/a.txt", "new");
  ASSERT_FALSE(in_a_file.ok());
  EXPECT_NE(in_a_file.error().message.find("file/a.txt"), std::string::npos);
  EXPECT_EQ(Text(folder_ / "file"), "old");
  const Status folder = MakeFolder(folder_ / "file");
  ASSERT_FALSE(folder.ok());
  EXPECT_NE(folder.error().message.find((folder_ / "file").string()), std::string::npos);
  // The reason is that of the making: the path names a file, or runs through one.
  const Status through = MakeFolder(folder_ / "file/deeper");
  ASSERT_FALSE(through.ok());
  EXPECT_NE(through.error().message.find("Not a directory"), std::string::npos)
      << through.error().message;
}

/// Sets a variable of the environment, null to none, and what it was at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) {
      before_ = before;
    }
    Set(value);
  }
  ~Variable() { Set(before_ ? before_->c_str() : nullptr); }
  Variable(const Variable&) = delete;

 private:
  void Set(const char* value) { value != nullptr ? setenv(name_, value, 1) : unsetenv(name_); }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(ConfigFolder, IsAnAbsolutePathOrNone) {
  const struct {
    const char *config, *home, *folder;
  } rows[] = {{"/c", "/h", "/c/palace"},
              {"c", "/h", "/h/.config/palace"},
              {"", "/h", "/h/.config/palace"},
              {nullptr, "/h", "/h/.config/palace"},
              {nullptr, "h", ""},
              {"c", nullptr, ""}};
  for (const auto& row : rows) {
    const Variable config("XDG_CONFIG_HOME", row.config), home("HOME", row.home);
    EXPECT_EQ(ConfigFolder(), fs::path(row.folder)) << row.folder;
  }
}

}  // namespace
}  // namespace palace
