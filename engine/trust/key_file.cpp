#include "engine/trust/key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>
#include <system_error>

#include <sodium.h>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstLine = "PALACE-KEY 1";
constexpr std::size_t kLargest = 4096;

/// A file descriptor that closes itself.
struct Opened {
  explicit Opened(int descriptor) : fd(descriptor) {}
  ~Opened() {
    if (fd >= 0) {
      close(fd);
    }
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  int fd;
};

/// The text of a key file, wiped at the end.
struct SecretText {
  ~SecretText() { sodium_memzero(bytes.data(), bytes.size()); }
  std::array<char, kLargest> bytes{};
  std::size_t size = 0;
  std::string_view view() const { return {bytes.data(), size}; }
};

std::string WhyUnsafe(const struct stat& info) {
  if (!S_ISREG(info.st_mode)) {
    return "is no plain file";
  }
  if (info.st_uid != geteuid() && info.st_uid != 0) {
    return "belongs to another user; make a key of your own with palacectl trust make";
  }
  if ((info.st_mode & 077) != 0) {
    return "can be read or written by others; run chmod 600 on it, and make a new key if others "
           "may have read it";
  }
  return info.st_size > static_cast<off_t>(kLargest) ? "is larger than 4 kB, no key file" : "";
}

Status ReadSecret(const fs::path& file, SecretText& text) {
  const Opened opened(open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (opened.fd < 0) {
    const std::string why =
        errno == ELOOP ? "is a link; give the file itself" : std::string(std::strerror(errno));
    return UnavailableError(file.string() + ": " + why +
                            "; palacectl trust list shows the keys there are");
  }
  struct stat info {};
  const std::string unsafe = fstat(opened.fd, &info) == 0 ? WhyUnsafe(info) : "cannot be examined";
  if (!unsafe.empty()) {
    return InvalidError(file.string() + " " + unsafe);
  }
  while (text.size < kLargest) {
    const ssize_t got = read(opened.fd, text.bytes.data() + text.size, kLargest - text.size);
    if (got < 0) {
      return UnavailableError(file.string() + ": " + std::strerror(errno));
    }
    if (got == 0) {
      break;
    }
    text.size += static_cast<std::size_t>(got);
  }
  return Ok();
}

std::string_view Trimmed(std::string_view line) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!line.empty() && blank(line.back())) {
    line.remove_suffix(1);
  }
  while (!line.empty() && blank(line.front())) {
    line.remove_prefix(1);
  }
  return line;
}

bool IsHex(std::string_view digits) {
  return digits.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
}

/// What the lines said so far.
struct KeyLines {
  std::optional<SecretKey> key;
  std::string fingerprint;
  bool made = false;
};

/// Empty when the line is fine. Words of an unknown line are not repeated: it may hold a key.
std::string TakeLine(std::string_view line, KeyLines& lines) {
  const std::size_t space = line.find(' ');
  const std::string_view word = line.substr(0, space);
  const std::string_view value =
      space == std::string_view::npos ? std::string_view() : Trimmed(line.substr(space));
  if (word == "key") {
    if (lines.key) {
      return "'key' is given twice";
    }
    if (value.size() != 2 * SecretKey::kBytes || !IsHex(value)) {
      return "'key' must be 64 hexadecimal digits, not " + std::to_string(value.size()) +
             " characters";
    }
    if (value.find_first_not_of('0') == std::string_view::npos) {
      return "'key' is all zeros; make one with palacectl trust make";
    }
    lines.key = SecretKey::FromHex(value);
    return {};
  }
  if (word == "fingerprint") {
    if (!lines.fingerprint.empty()) {
      return "'fingerprint' is given twice";
    }
    lines.fingerprint = value;
    return value.size() == 19 ? "" : "'fingerprint' must be four groups of four digits";
  }
  if (word == "made") {
    return std::exchange(lines.made, true) ? "'made' is given twice" : "";
  }
  return "neither 'key', 'fingerprint' nor 'made' begins it";
}

Result<SecretKey> ParseKey(std::string_view text, const std::string& origin) {
  KeyLines lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = Trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    const auto wrong = [&](const std::string& why) {
      return InvalidError(origin + ":" + std::to_string(number) + ": " + Printable(why));
    };
    if (number == 1) {
      if (line != kFirstLine) {
        return wrong("a key file begins with the line '" + std::string(kFirstLine) + "'");
      }
      continue;
    }
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const std::string why = TakeLine(line, lines);
    if (!why.empty()) {
      return wrong(why);
    }
  }
  if (!lines.key) {
    return InvalidError(origin + ": no line 'key'; make one with palacectl trust make");
  }
  const std::string fingerprint = FingerprintText(lines.key->id());
  if (lines.fingerprint != fingerprint) {
    return InvalidError(origin + ": fingerprint " +
                        (lines.fingerprint.empty() ? "is missing" : lines.fingerprint) +
                        ", the key's own is " + fingerprint + "; a digit of the key was changed");
  }
  return *lines.key;
}

std::string NowText() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

Status WriteAll(int fd, const fs::path& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(fd, text.data(), text.size());
    if (written < 0) {
      return UnavailableError(file.string() + ": " + std::strerror(errno));
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (fsync(fd) != 0) {
    return UnavailableError(file.string() + ": " + std::strerror(errno));
  }
  return Ok();
}

fs::path FileOf(const std::string& name, const fs::path& folder) {
  return folder / (name + ".key");
}

Status CheckFolder(const std::string& name, const fs::path& folder) {
  const std::string why = WhyNoKeyName(name);
  if (!why.empty()) {
    return UsageError("the name '" + name + "' " + why);
  }
  return folder.empty() ? Status(UsageError("no folder for keys: set HOME or give --keys DIR"))
                        : Ok();
}

}  // namespace

fs::path DefaultKeyFolder() {
  const fs::path config = ConfigFolder();
  return config.empty() ? config : config / "keys";
}

std::string WhyNoKeyName(const std::string& name) {
  if (name.empty() || name.size() > 40) {
    return "has " + std::to_string(name.size()) + " characters; give 1 to 40";
  }
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  });
  return plain && name.front() != '.' ? "" : "may hold letters, digits, '-', '_' and '.' only";
}

Result<NamedKey> LoadKeyFile(const fs::path& file) {
  SecretText text;
  const Status read = ReadSecret(file, text);
  if (!read) {
    return read.error();
  }
  Result<SecretKey> key = ParseKey(text.view(), file.string());
  if (!key) {
    return key.error();
  }
  return NamedKey{file.stem().string(), file, *key};
}

Result<NamedKey> FindKey(const std::string& name_or_file, const fs::path& folder) {
  if (name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".key")) {
    return LoadKeyFile(name_or_file);
  }
  const Status usable = CheckFolder(name_or_file, folder);
  if (!usable) {
    return usable.error();
  }
  const fs::path file = FileOf(name_or_file, folder);
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) {
    return UnavailableError("there is no key '" + name_or_file + "' (" + file.string() +
                            "); make it with palacectl trust make " + name_or_file +
                            ", or copy the vehicle's file there");
  }
  return LoadKeyFile(file);
}

Result<NamedKey> MakeKeyFile(const std::string& name, const fs::path& folder) {
  const Status usable = CheckFolder(name, folder);
  if (!usable) {
    return usable.error();
  }
  std::error_code failed;
  if (fs::create_directories(folder, failed)) {
    fs::permissions(folder, fs::perms::owner_all, failed);
  }
  if (failed) {
    return UnavailableError(folder.string() + ": " + failed.message());
  }
  const fs::path file = FileOf(name, folder);
  const Opened opened(
      open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (opened.fd < 0) {
    return errno == EEXIST ? UsageError(file.string() +
                                        " is there already; remove it first with "
                                        "palacectl trust remove " +
                                        name)
                           : UnavailableError(file.string() + ": " + std::strerror(errno));
  }
  const SecretKey key = SecretKey::Random();
  const std::string head = std::string(kFirstLine) + "\nmade " + NowText() + "\nfingerprint " +
                           FingerprintText(key.id()) + "\nkey ";
  Status written = WriteAll(opened.fd, file, head);
  if (written) {
    written =
        key.WithHex([&](std::string_view digits) { return WriteAll(opened.fd, file, digits); });
  }
  if (written) {
    written = WriteAll(opened.fd, file, "\n");
  }
  if (!written) {
    fs::remove(file, failed);
    return written.error();
  }
  return NamedKey{name, file, key};
}

Status RemoveKeyFile(const std::string& name, const fs::path& folder) {
  const Status usable = CheckFolder(name, folder);
  if (!usable) {
    return usable.error();
  }
  const fs::path file = FileOf(name, folder);
  if (unlink(file.c_str()) != 0) {
    return UnavailableError(file.string() + ": " + std::strerror(errno) +
                            "; palacectl trust list shows the keys there are");
  }
  return Ok();
}

std::vector<fs::path> KeyFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".key") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace palace
