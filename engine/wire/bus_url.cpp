#include "engine/wire/bus_url.h"

#include <arpa/inet.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace palace {
namespace {

constexpr int kReceiveBuffer = 4194304;
constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667";
constexpr const char* kExample = "; give e.g. udpm://239.255.76.67:7667?ttl=0";

bool IsMulticast(const std::string& url) { return url.rfind("udpm://", 0) == 0; }

/// Value of an option, "4194304" of recv_buf_size; nothing when it is not given.
std::optional<std::string_view> Option(std::string_view url, std::string_view key) {
  std::size_t at = url.find('?');
  while (at != std::string_view::npos) {
    const std::size_t end = url.find('&', at + 1);
    const std::string_view option = url.substr(at + 1, end - at - 1);
    if (option.substr(0, option.find('=')) == key) {
      const std::size_t equals = option.find('=');
      return equals == std::string_view::npos ? "" : option.substr(equals + 1);
    }
    at = end;
  }
  return std::nullopt;
}

bool ParseNumber(std::string_view text, int least, int most, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= least &&
         number <= most;
}

Result<BusPlace> ParseGroup(const std::string& url) {
  const auto refuse = [&](const std::string& problem) {
    return UsageError("LCM URL " + url + ": " + problem + kExample);
  };
  BusPlace place;
  const std::size_t from = std::string_view("udpm://").size();
  const std::string where = url.substr(from, url.find('?') - from);
  const std::size_t colon = where.find(':');
  const std::string address = where.substr(0, colon);
  in_addr parsed{};
  if (!where.empty()) {
    if (inet_pton(AF_INET, address.c_str(), &parsed) != 1 || (ntohl(parsed.s_addr) >> 28) != 0xE) {
      return refuse("'" + address + "' is no multicast address, 224.0.0.0 to 239.255.255.255");
    }
    place.group.ip = ntohl(parsed.s_addr);
  }
  int number = 0;
  if (colon != std::string::npos) {
    if (!ParseNumber(where.substr(colon + 1), 1, 65535, number)) {
      return refuse("'" + where.substr(colon + 1) + "' is no port, 1 to 65535");
    }
    place.group.port = static_cast<std::uint16_t>(number);
  }
  if (const auto size = Option(url, "recv_buf_size")) {
    if (!ParseNumber(*size, 1, 1 << 30, number)) {
      return refuse("recv_buf_size is '" + std::string(*size) + "', not 1 to 1073741824 bytes");
    }
    place.group.receive_buffer_bytes = number;
  }
  if (const auto ttl = Option(url, "ttl"); ttl && !ParseNumber(*ttl, 0, 255, number)) {
    return refuse("ttl is '" + std::string(*ttl) + "', not 0 to 255");
  }
  return place;
}

}  // namespace

std::string CompleteLcmUrl(const std::string& url) {
  std::string complete = url.empty() ? kDefaultUrl : url;
  if (!IsMulticast(complete)) {
    return complete;
  }
  const auto append = [&complete](const std::string& key, const std::string& value) {
    if (!Option(complete, key)) {
      complete += (complete.find('?') == std::string::npos ? "?" : "&") + key + "=" + value;
    }
  };
  append("recv_buf_size", std::to_string(kReceiveBuffer));
  append("ttl", "0");
  return complete;
}

Result<BusPlace> ParseBusUrl(const std::string& url) {
  if (IsMulticast(url)) {
    return ParseGroup(url);
  }
  const std::size_t end = url.find("://");
  const std::string scheme = end == std::string::npos ? "" : url.substr(0, end);
  if (scheme == "memq") {
    return BusPlace{.in_memory = true};
  }
  if (scheme == "tcpq" || scheme == "mpudpm" || scheme == "file") {
    return UsageError(
        "LCM URL " + url + ": " + scheme +
        " is not taken, for only udpm is received with bounds on what a sender can do" +
        (scheme == "file" ? "; play a log with --replay" : kExample));
  }
  return UsageError("LCM URL " + url + ": no such kind of bus" + kExample);
}

}  // namespace palace
