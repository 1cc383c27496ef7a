// Key files: what is read, what is refused, and that no message holds a digit of a key.
#include "engine/trust/key_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kDigits = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";

class KeyFile : public testing::Test {
 protected:
  KeyFile() : folder_(OwnPath()) { fs::remove_all(folder_); }
  ~KeyFile() override {
    std::error_code none;
    fs::remove_all(folder_, none);
  }
  fs::path Write(const std::string& text, mode_t mode = 0600) {
    fs::create_directories(folder_);
    const fs::path file = folder_ / "heli-1.key";
    std::ofstream(file, std::ios::binary) << text;
    chmod(file.c_str(), mode);
    return file;
  }
  static std::string Good() {
    return "PALACE-KEY 1\n# of the first\nfingerprint " +
           FingerprintText(SecretKey::FromHex(kDigits).id()) + "\nkey " + kDigits + "\n";
  }
  fs::path folder_;
};

TEST_F(KeyFile, IsMadeForItsOwnerAloneAndReadBack) {
  const auto made = MakeKeyFile("heli-1", folder_);
  ASSERT_TRUE(made.ok()) << made.error().message;
  struct stat info {};
  ASSERT_EQ(stat(made->file.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  ASSERT_EQ(stat(folder_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0700u);
  const auto read = FindKey("heli-1", folder_);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->key.id(), made->key.id());
  EXPECT_EQ(read->name, "heli-1");
  EXPECT_TRUE(FindKey(made->file.string(), "").ok()) << "by its file";
  EXPECT_THAT(MakeKeyFile("heli-1", folder_).error().message, HasSubstr("is there already"));
  const auto second = MakeKeyFile("heli-2", folder_);
  EXPECT_NE(second->key.id(), made->key.id());
  EXPECT_EQ(KeyFilesIn(folder_).size(), 2u);
  EXPECT_TRUE(RemoveKeyFile("heli-2", folder_).ok());
  EXPECT_FALSE(RemoveKeyFile("heli-2", folder_).ok());
  EXPECT_EQ(KeyFilesIn(folder_).size(), 1u);
}

TEST_F(KeyFile, IsRefusedWithLineAndReason) {
  const std::string id = "fingerprint " + FingerprintText(SecretKey::FromHex(kDigits).id()) + "\n";
  const std::string key = std::string("key ") + kDigits + "\n";
  const std::string first = "PALACE-KEY 1\n";
  const struct {
    const char* name;
    std::string text;
    const char* why;
  } rows[] = {
      {"empty", "", "no line 'key'"},
      {"another version", "PALACE-KEY 2\n" + id + key, ":1: a key file begins with"},
      {"no version", id + key, ":1: a key file begins with"},
      {"a log", std::string("\xED\xA1\xDA\x01\0\0\0\0", 8), ":1: a key file begins with"},
      {"no key", first + id, "no line 'key'"},
      {"short", first + id + "key 0011\n", ":3: 'key' must be 64 hexadecimal digits, not 4"},
      {"long", first + id + "key " + kDigits + "0\n", ":3: 'key' must be 64"},
      {"not digits", first + id + "key " + std::string(64, 'g') + "\n", ":3: 'key' must be 64"},
      {"zeros", first + id + "key " + std::string(64, '0') + "\n", ":3: 'key' is all zeros"},
      {"twice", first + id + key + key, ":4: 'key' is given twice"},
      {"garbage", first + id + key + "x\n", ":4: neither"},
      {"its own digits astray", first + id + kDigits + "\n", ":3: neither"},
      {"no fingerprint", first + key, "fingerprint is missing"},
      {"other fingerprint", first + "fingerprint 0000-0000-0000-0000\n" + key, "the key's own is"},
      {"a digit changed", first + id + "key 1" + std::string(kDigits).substr(1) + "\n",
       "a digit of the key was changed"},
      {"huge", first + std::string(5000, '#'), "larger than 4 kB"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.name);
    const fs::path file = Write(row.text);
    const auto key_read = LoadKeyFile(file);
    ASSERT_FALSE(key_read.ok());
    EXPECT_THAT(key_read.error().message, HasSubstr(row.why));
    EXPECT_THAT(key_read.error().message, HasSubstr(file.string()));
    EXPECT_THAT(key_read.error().message, Not(HasSubstr("00112233"))) << "a digit of the key";
  }
  EXPECT_TRUE(LoadKeyFile(Write(Good())).ok());
}

TEST_F(KeyFile, IsRefusedWhereOthersMayReadItOrItIsNotItself) {
  for (const mode_t mode : {0640, 0604, 0620, 0602, 0660, 0644, 0666, 0610}) {
    const auto read = LoadKeyFile(Write(Good(), mode));
    ASSERT_FALSE(read.ok()) << std::oct << mode;
    EXPECT_THAT(read.error().message, HasSubstr("chmod 600"));
  }
  const fs::path file = Write(Good());
  EXPECT_TRUE(LoadKeyFile(file).ok());
  const fs::path link = folder_ / "link.key";
  fs::create_symlink(file, link);
  EXPECT_THAT(LoadKeyFile(link).error().message, HasSubstr("is a link"));
  const fs::path pipe = folder_ / "pipe.key";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(LoadKeyFile(pipe).error().message, HasSubstr("no plain file"));
  EXPECT_FALSE(LoadKeyFile(folder_).ok());
  EXPECT_THAT(FindKey("none", folder_).error().message, HasSubstr("palacectl trust make none"));
}

TEST_F(KeyFile, NamesArePlain) {
  for (const char* name : {"", ".", "..", ".hidden", "a/b", "a b", "ä", "x\n"}) {
    EXPECT_NE(WhyNoKeyName(name), "") << name;
    EXPECT_FALSE(MakeKeyFile(name, folder_).ok()) << name;
  }
  EXPECT_NE(WhyNoKeyName(std::string(41, 'a')), "");
  EXPECT_EQ(WhyNoKeyName("heli-1_b.2"), "");
}

TEST(SecretKey, FingerprintIsFourGroupsAndSaysNothingOfTheKey) {
  const SecretKey key = SecretKey::FromHex(kDigits);
  const std::string text = FingerprintText(key.id());
  EXPECT_EQ(text.size(), 19u);
  EXPECT_THAT(text, Not(HasSubstr("0011")));
  EXPECT_NE(SecretKey::Random().id(), SecretKey::Random().id());
  EXPECT_EQ(SecretKey::FromSeed(4).id(), SecretKey::FromSeed(4).id());
  EXPECT_EQ(FingerprintText(0x3F2A91C077B4E0D2), "3F2A-91C0-77B4-E0D2");
}

}  // namespace
}  // namespace palace
