// bus_storm: storms on a bus, and what is heard meanwhile. Run inside a private network only.
//
//   bus_storm URL flood killing|claims|random|payloads SEED COUNT RATE_HZ   (rate 0: unbounded)
//   bus_storm URL listen SECONDS            a line each: monotonic seconds, channel
//   bus_storm URL wave-off COUNT SECONDS    a whole station without a window: says "ready" when it
//                                           hears a vehicle, waits so long, orders COUNT wave-offs;
//                                           the slowest from order to wire, ms
#include "tests/support/bus_storm.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <mutex>
#include <set>
#include <thread>

#include "engine/core/time.h"
#include "engine/runtime/engine.h"
#include "engine/wire/bus.h"
#include "engine/wire/convert.h"
#include "engine/wire/lcm_link.h"
#include "engine/wire/lcm_source.h"
#include "engine/wire/receiver/udp_socket.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

int Fail(const std::string& message) {
  std::cerr << "bus_storm: " << message << "\n";
  return 1;
}

void SleepFor(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::vector<std::pair<std::string, Bytes>> Samples() {
  RandomStream random(1);
  std::vector<std::pair<std::string, Bytes>> samples;
  for (const WireMessage& message : OneOfEach(random)) {
    samples.push_back({message.channel, message.payload});
  }
  return samples;
}

int Flood(const UdpGroup& group, const std::string& kind, std::uint32_t seed, int count,
          double rate_hz) {
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  const unsigned char ttl = 0;
  setsockopt(out, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(group.ip);
  place.sin_port = htons(group.port);
  BusStorm storm(seed, Samples());
  const auto send = [&](const Bytes& datagram) {
    sendto(out, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&place),
           sizeof place);
  };
  const double start_s = MonotonicSeconds();
  for (int i = 0; i < count; ++i) {
    if (kind == "killing") {
      for (const auto& [channel, payload] : Samples()) {
        for (const Bytes& datagram : BusStorm::Killing(channel)) {
          send(datagram);
        }
      }
    } else {
      send(kind == "claims" ? storm.Claim() : kind == "random" ? storm.Random() : storm.Payload());
    }
    const double ahead_s = rate_hz > 0 ? (i + 1) / rate_hz - (MonotonicSeconds() - start_s) : 0;
    if (ahead_s > 0.002) {
      SleepFor(ahead_s);
    }
  }
  std::printf("%d in %.2f s\n", count, MonotonicSeconds() - start_s);
  close(out);
  return 0;
}

int Listen(UdpSocket socket, double seconds) {
  LcmReassembler receiver;
  const ChannelNames names;
  for (const std::string& channel :
       {names.station_status, names.site_proposal, names.position_estimate, names.abort,
        names.event, names.vehicle_status}) {
    receiver.Allow(channel, 1u << 20);
  }
  const double start_s = MonotonicSeconds();
  while (MonotonicSeconds() - start_s < seconds) {
    for (const UdpSocket::Datagram& datagram : socket.Receive()) {
      const double now_s = MonotonicSeconds();
      const auto taken = receiver.Take(datagram.from, datagram.data, datagram.size, now_s);
      if (taken.outcome == LcmReassembler::Outcome::kMessage) {
        std::printf("%.6f %s\n", now_s, taken.message.channel.c_str());
      }
    }
    std::fflush(stdout);
  }
  return 0;
}

/// A station's link, and the numbers of the wave-offs that went over it: a stranger's have others.
class NotedLink final : public VehicleLink {
 public:
  explicit NotedLink(std::shared_ptr<LcmLink> link) : link_(std::move(link)) {}
  bool Send(const VehicleMessage& message) override {
    if (const auto* abort = std::get_if<AbortRequest>(&message)) {
      const std::lock_guard lock(mutex_);
      sent_.insert(abort->command_id);
    }
    return link_->Send(message);
  }
  void Seal(VehicleMessage& message) override { link_->Seal(message); }
  void Hear(const FrameBundle& bundle) override { link_->Hear(bundle); }
  AuthorityStatus Authority() const override { return link_->Authority(); }
  void Announce(const EngineSnapshot& snapshot) override { link_->Announce(snapshot); }
  std::uint64_t Unsent() const override { return link_->Unsent(); }
  bool IsOwn(const LcmReassembler::Taken& taken) {
    const auto message =
        DecodeVehicleMessage({ChannelNames{}.abort, {}, taken.message.payload}, {});
    const std::lock_guard lock(mutex_);
    return message && sent_.count(std::get<AbortRequest>(*message).command_id) > 0;
  }

 private:
  std::shared_ptr<LcmLink> link_;
  std::mutex mutex_;
  std::set<std::uint64_t> sent_;
};

/// Polls until it is so; false after that long.
bool Wait(const std::function<bool()>& done, double seconds) {
  for (const double start_s = MonotonicSeconds(); !done();) {
    if (MonotonicSeconds() - start_s > seconds) {
      return false;
    }
    SleepFor(0.01);
  }
  return true;
}

/// From the order to a wave-off of our own on the wire, s; NaN: not within 5 s.
double WaveOffTime(Engine& engine, NotedLink& link, LcmReassembler& receiver, UdpSocket& socket) {
  const double ordered_s = MonotonicSeconds();
  engine.Post({CommandOrigin::kOperator, WaveOff{}});
  while (MonotonicSeconds() - ordered_s < 5) {
    for (const UdpSocket::Datagram& datagram : socket.Receive()) {
      const double now_s = MonotonicSeconds();
      const auto taken = receiver.Take(datagram.from, datagram.data, datagram.size, now_s);
      if (taken.outcome == LcmReassembler::Outcome::kMessage && link.IsOwn(taken)) {
        return now_s - ordered_s;
      }
    }
  }
  return NAN;
}

int WaveOffs(const std::string& url, UdpSocket socket, int count, double wait_s) {
  const auto bus = Bus::Open(url);
  if (!bus) {
    return Fail(bus.error().message);
  }
  const auto link = std::make_shared<NotedLink>(std::make_shared<LcmLink>(*bus));
  EngineParts parts;
  parts.source = LcmSource::Create(*bus).value();
  parts.link = link;
  parts.mission.session_id = 1;
  Engine engine(std::move(parts), /*threaded=*/true);
  engine.Start();
  const auto flies = [&] {
    const auto newest = engine.Latest();
    return newest && newest->sensors->vehicle && newest->flight->mission.why_no_wave_off.empty();
  };
  if (!Wait(flies, 30)) {
    return Fail("no vehicle was heard within 30 s");
  }
  std::printf("ready\n");
  std::fflush(stdout);
  SleepFor(wait_s);  // for the storm
  LcmReassembler receiver;
  receiver.Allow(ChannelNames{}.abort, 4096);
  double slowest_s = 0;
  for (int i = 0; i < count; ++i) {
    if (!Wait(flies, 10)) {
      return Fail("the station holds the vehicle for landed");
    }
    const double time_s = WaveOffTime(engine, *link, receiver, socket);
    if (std::isnan(time_s)) {
      return Fail("a wave-off was not heard within 5 s");
    }
    slowest_s = std::max(slowest_s, time_s);
    SleepFor(0.1);
  }
  std::printf("%.2f\n", 1e3 * slowest_s);
  const Status stopped = engine.Stop();
  return stopped ? 0 : Fail(stopped.error().message);
}

int Run(const std::vector<std::string>& words) {
  const auto number = [&](std::size_t i) {
    return i < words.size() ? std::atof(words[i].c_str()) : 0;
  };
  if (words.size() < 3) {
    return Fail("usage: bus_storm URL flood|listen|wave-off ...");
  }
  const Result<BusPlace> place = ParseBusUrl(CompleteLcmUrl(words[0]));
  if (!place) {
    return Fail(place.error().message);
  }
  if (words[1] == "flood" && words.size() == 6) {
    return Flood(place->group, words[2], static_cast<std::uint32_t>(number(3)),
                 static_cast<int>(number(4)), number(5));
  }
  Result<UdpSocket> socket = UdpSocket::Join(place->group);
  if (!socket) {
    return Fail(socket.error().message);
  }
  if (words[1] == "listen") {
    return Listen(std::move(*socket), number(2));
  }
  return words[1] == "wave-off"
             ? WaveOffs(words[0], std::move(*socket), static_cast<int>(number(2)), number(3))
             : Fail("unknown mode '" + words[1] + "'");
}

}  // namespace
}  // namespace palace

int main(int count, char** words) { return palace::Run({words + 1, words + count}); }
