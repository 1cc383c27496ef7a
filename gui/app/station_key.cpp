#include "gui/app/station_key.h"

#include <unistd.h>

#include <array>
#include <utility>

#include "engine/core/log.h"
#include "engine/trust/key_file.h"

namespace palace {
namespace {

std::string HostName() {
  std::array<char, 61> name{};
  const bool known = gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0';
  return known ? name.data() : "station";
}

constexpr const char* kNoKey =
    "No key for this vehicle: run palacectl trust make NAME, give the vehicle the same file, start "
    "with --key NAME";

}  // namespace

Result<StationTrust> StationTrustFor(const std::string& wanted,
                                     const std::filesystem::path& folder) {
  StationTrust trust;
  trust.station_id = RandomWord();
  trust.station_name = HostName();
  trust.no_key_why = kNoKey;
  const auto files = KeyFilesIn(folder);
  if (wanted.empty() && files.size() != 1) {
    if (!files.empty()) {
      trust.no_key_why = "Several keys in " + folder.string() + ": start with --key NAME";
    }
    return trust;
  }
  const Result<NamedKey> key =
      wanted.empty() ? LoadKeyFile(files.front()) : FindKey(wanted, folder);
  if (!key) {
    if (!wanted.empty()) {
      return key.error();
    }
    LogWarning(key.error().message);
    trust.no_key_why = "The key cannot be used: " + key.error().message;
    return trust;
  }
  trust.key = key->key;
  trust.key_name = key->name;
  LogInfo("key " + key->name + ", fingerprint " + FingerprintText(key->key.id()));
  return trust;
}

}  // namespace palace
