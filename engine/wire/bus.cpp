#include "engine/wire/bus.h"

#include <arpa/inet.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <utility>

#include <lcm/lcm.h>

#include "engine/core/time.h"

namespace palace {
namespace {

constexpr long kReceiveBuffer = 4194304;
constexpr std::uint32_t kLargestMessage = 64u << 20;
constexpr std::size_t kLongestChannel = 63;
constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667";

bool IsMulticast(const std::string& url) { return url.rfind("udpm://", 0) == 0; }

/// Subscriptions are regular expressions; a channel is meant literally.
std::string Escaped(const std::string& channel) {
  std::string pattern;
  for (const char c : channel) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') {
      pattern += '\\';
    }
    pattern += c;
  }
  return pattern;
}

/// What is wrong with a URL; liblcm would say it on stderr only.
std::string UrlProblem(const std::string& url) {
  const std::size_t scheme_end = url.find("://");
  const std::string scheme = url.substr(0, scheme_end);
  if (scheme_end == std::string::npos ||
      (scheme != "udpm" && scheme != "memq" && scheme != "tcpq" && scheme != "file" &&
       scheme != "mpudpm")) {
    return "no such kind of bus; give e.g. udpm://239.255.76.67:7667?ttl=0";
  }
  if (!IsMulticast(url)) {
    return {};
  }
  const std::string place = url.substr(scheme_end + 3, url.find('?') - scheme_end - 3);
  const std::string address = place.substr(0, place.find(':'));
  in_addr parsed{};
  if (!place.empty() &&
      (inet_pton(AF_INET, address.c_str(), &parsed) != 1 || (ntohl(parsed.s_addr) >> 28) != 0xE)) {
    return "'" + address +
           "' is no multicast address; give one of 224.0.0.0 to 239.255.255.255, e.g. "
           "udpm://239.255.76.67:7667?ttl=0";
  }
  return {};
}

std::vector<std::string> CheckReceiveBuffer() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  long largest = 0;
  if (!(file >> largest) || largest >= kReceiveBuffer) {
    return {};
  }
  return {"The kernel allows receive buffers of " + std::to_string(largest) +
          " bytes only, so pictures will be lost. Run: sudo sysctl -w net.core.rmem_max=" +
          std::to_string(kReceiveBuffer)};
}

}  // namespace

std::string CompleteLcmUrl(const std::string& url) {
  std::string complete = url.empty() ? kDefaultUrl : url;
  if (!IsMulticast(complete)) {
    return complete;
  }
  const auto append = [&complete](const std::string& key, const std::string& value) {
    const std::size_t options = complete.find('?');
    if (options != std::string::npos) {
      const std::string rest = "&" + complete.substr(options + 1);
      if (rest.find("&" + key + "=") != std::string::npos) {
        return;
      }
    }
    complete += (options == std::string::npos ? "?" : "&") + key + "=" + value;
  };
  append("recv_buf_size", std::to_string(kReceiveBuffer));
  append("ttl", "0");
  return complete;
}

struct Bus::Impl {
  struct Listener {
    Impl* owner = nullptr;
    Handler handler;
  };

  ~Impl() {
    if (lcm != nullptr) {
      lcm_destroy(lcm);
    }
  }
  /// Called by liblcm. A datagram without a terminated channel name arrives with a size near 2^32
  /// and a name run into old bytes (reference: reliability 1.5); both are refused here.
  static void OnMessage(const lcm_recv_buf_t* received, const char* channel, void* user) {
    auto* listener = static_cast<Listener*>(user);
    const std::string name = channel != nullptr ? channel : "";
    if (received == nullptr || received->data == nullptr || received->data_size > kLargestMessage ||
        name.empty() || name.size() > kLongestChannel) {
      ++listener->owner->dropped;
      return;
    }
    const auto* bytes = static_cast<const std::uint8_t*>(received->data);
    listener->handler({name, {received->recv_utime}, {bytes, bytes + received->data_size}});
  }

  lcm_t* lcm = nullptr;
  std::string url;
  std::vector<std::string> warnings;
  std::vector<std::unique_ptr<Listener>> listeners;
  std::uint64_t dropped = 0;
};

Bus::Bus(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Bus::~Bus() = default;

Result<std::shared_ptr<Bus>> Bus::Open(const std::string& url) {
  const char* preset = std::getenv("LCM_DEFAULT_URL");
  auto impl = std::make_unique<Impl>();
  impl->url = CompleteLcmUrl(url.empty() && preset != nullptr ? preset : url);
  const std::string problem = UrlProblem(impl->url);
  if (!problem.empty()) {
    return UsageError("LCM URL " + impl->url + ": " + problem);
  }
  impl->lcm = lcm_create(impl->url.c_str());
  if (impl->lcm == nullptr) {
    std::string advice = "check the URL, e.g. udpm://239.255.76.67:7667";
    if (IsMulticast(impl->url)) {
      advice =
          "multicast needs a route; on one machine run: sudo ip link set lo multicast on && sudo "
          "ip route add 224.0.0.0/4 dev lo";
    }
    return UnavailableError("cannot join the LCM bus " + impl->url + ": " + advice);
  }
  if (IsMulticast(impl->url)) {
    impl->warnings = CheckReceiveBuffer();
  }
  return std::shared_ptr<Bus>(new Bus(std::move(impl)));
}

const std::string& Bus::url() const { return impl_->url; }
const std::vector<std::string>& Bus::warnings() const { return impl_->warnings; }
std::uint64_t Bus::dropped() const { return impl_->dropped; }

Status Bus::Publish(const WireMessage& message) {
  const int published = lcm_publish(impl_->lcm, message.channel.c_str(), message.payload.data(),
                                    static_cast<unsigned int>(message.payload.size()));
  if (published != 0) {
    return UnavailableError("cannot publish " + message.channel + " (" +
                            std::to_string(message.payload.size()) + " bytes) on " + impl_->url +
                            ": check the network link");
  }
  return Ok();
}

Status Bus::Subscribe(const std::string& channel, Handler handler, int queue_capacity) {
  impl_->listeners.push_back(
      std::make_unique<Impl::Listener>(Impl::Listener{impl_.get(), std::move(handler)}));
  lcm_subscription_t* subscription = lcm_subscribe(impl_->lcm, Escaped(channel).c_str(),
                                                   &Impl::OnMessage, impl_->listeners.back().get());
  if (subscription == nullptr) {
    impl_->listeners.pop_back();
    return UnavailableError("cannot subscribe to " + channel + " on " + impl_->url);
  }
  lcm_subscription_set_queue_capacity(subscription, queue_capacity);
  return Ok();
}

Result<bool> Bus::Handle(int timeout_ms) {
  const int handled = lcm_handle_timeout(impl_->lcm, timeout_ms);
  if (handled < 0 && errno != EINTR) {
    return UnavailableError("the LCM bus " + impl_->url + " failed; reconnect");
  }
  return handled > 0;
}

}  // namespace palace
