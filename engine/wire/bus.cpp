#include "engine/wire/bus.h"

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <lcm/lcm.h>

#include "engine/wire/receiver/bus_receiver.h"

namespace palace {
namespace {

/// Subscriptions of liblcm are regular expressions; a channel is meant literally.
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

std::vector<std::string> CheckReceiveBuffer(int wanted) {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  long largest = 0;
  if (!(file >> largest) || largest >= wanted) {
    return {};
  }
  return {"The kernel allows receive buffers of " + std::to_string(largest) +
          " bytes only, so pictures will be lost. Run: sudo sysctl -w net.core.rmem_max=" +
          std::to_string(wanted)};
}

Error CannotJoin(const std::string& url, const std::string& reason) {
  return UnavailableError("cannot join the LCM bus " + url + reason +
                          ": multicast needs a route; on one machine run: sudo ip link set lo "
                          "multicast on && sudo ip route add 224.0.0.0/4 dev lo");
}

}  // namespace

struct Bus::Impl {
  struct Listener {
    Handler handler;
    std::size_t most_bytes = 0;
  };

  ~Impl() {
    if (lcm != nullptr) {
      lcm_destroy(lcm);
    }
  }
  /// Called by liblcm, of memq alone: what comes was published in this process.
  static void OnMessage(const lcm_recv_buf_t* received, const char* channel, void* user) {
    const auto* listener = static_cast<Listener*>(user);
    if (received->data_size <= listener->most_bytes) {
      const auto* bytes = static_cast<const std::uint8_t*>(received->data);
      listener->handler({channel, {received->recv_utime}, {bytes, bytes + received->data_size}});
    }
  }

  lcm_t* lcm = nullptr;
  std::string url;
  std::vector<std::string> warnings;
  std::multimap<std::string, std::unique_ptr<Listener>> listeners;
  std::optional<UdpGroup> group;          ///< of udpm
  std::unique_ptr<BusReceiver> receiver;  ///< of udpm, from the first subscription
};

Bus::Bus(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Bus::~Bus() = default;

Result<std::shared_ptr<Bus>> Bus::Open(const std::string& url) {
  const char* preset = std::getenv("LCM_DEFAULT_URL");
  auto impl = std::make_unique<Impl>();
  impl->url = CompleteLcmUrl(url.empty() && preset != nullptr ? preset : url);
  const Result<BusPlace> place = ParseBusUrl(impl->url);
  if (!place) {
    return place.error();
  }
  impl->lcm = lcm_create(impl->url.c_str());
  if (impl->lcm == nullptr) {
    return CannotJoin(impl->url, "");
  }
  if (!place->in_memory) {
    impl->group = place->group;
    impl->warnings = CheckReceiveBuffer(place->group.receive_buffer_bytes);
  }
  return std::shared_ptr<Bus>(new Bus(std::move(impl)));
}

const std::string& Bus::url() const { return impl_->url; }
const std::vector<std::string>& Bus::warnings() const { return impl_->warnings; }

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

Status Bus::Subscribe(const std::string& channel, Handler handler, ChannelLimits limits) {
  auto listener =
      std::make_unique<Impl::Listener>(Impl::Listener{std::move(handler), limits.message_bytes});
  if (impl_->group) {
    if (!impl_->receiver) {
      Result<UdpSocket> socket = UdpSocket::Join(*impl_->group);
      if (!socket) {
        return CannotJoin(impl_->url, " (" + socket.error().message + ")");
      }
      impl_->receiver = std::make_unique<BusReceiver>(std::move(*socket));
    }
    impl_->receiver->Open(channel, limits);
  } else {
    lcm_subscription_t* subscription =
        lcm_subscribe(impl_->lcm, Escaped(channel).c_str(), &Impl::OnMessage, listener.get());
    if (subscription == nullptr) {
      return UnavailableError("cannot subscribe to " + channel + " on " + impl_->url);
    }
    lcm_subscription_set_queue_capacity(subscription, static_cast<int>(limits.queue_messages));
  }
  impl_->listeners.emplace(channel, std::move(listener));
  return Ok();
}

Result<bool> Bus::Handle(int timeout_ms) {
  if (impl_->group) {
    std::optional<QueuedMessage> next =
        impl_->receiver ? impl_->receiver->Next(timeout_ms) : std::nullopt;
    if (next) {
      ReceivedMessage& got = next->message;
      WireMessage message{got.channel, next->arrived, std::move(got.payload), ToText(got.sender)};
      const auto [first, last] = impl_->listeners.equal_range(got.channel);
      for (auto listener = first; std::next(listener) != last; ++listener) {
        listener->second->handler(message);
      }
      std::prev(last)->second->handler(std::move(message));
    }
    return next.has_value();
  }
  const int handled = lcm_handle_timeout(impl_->lcm, timeout_ms);
  if (handled < 0 && errno != EINTR) {
    return UnavailableError("the LCM bus " + impl_->url + " failed; reconnect");
  }
  return handled > 0;
}

BusTraffic Bus::traffic() const {
  return impl_->receiver ? impl_->receiver->Traffic() : BusTraffic{};
}

std::vector<RefusedDatagram> Bus::TakeRefused() {
  return impl_->receiver ? impl_->receiver->TakeRefused() : std::vector<RefusedDatagram>{};
}

}  // namespace palace
