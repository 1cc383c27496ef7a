#include <algorithm>

#include "engine/wire/convert.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {

WireMessage EncodeRefused(const RefusedDatagram& refused, Timestamp now,
                          const ChannelNames& channels) {
  refused_t m{};
  m.utime = now.us;
  m.wall_utime = refused.time.us;
  m.sender = refused.sender;
  m.channel = refused.channel;
  m.reason = refused.reason;
  m.bytes = static_cast<std::int32_t>(refused.bytes);
  m.like_it = static_cast<std::int64_t>(refused.like_it);
  m.head = refused.head;
  m.head_size = static_cast<std::int32_t>(m.head.size());
  return MakeMessage(channels.refused, now, m);
}

Result<RefusedDatagram> DecodeRefused(const WireMessage& message) {
  return DecodeAnd<refused_t>(message, [](const refused_t& m) -> Result<RefusedDatagram> {
    if (m.bytes < 0 || m.like_it < 1 || m.head.size() > kRefusedBytesKept) {
      return InvalidError("a refused datagram of " + std::to_string(m.bytes) + " bytes, kept " +
                          std::to_string(m.head.size()) + ", limit " +
                          std::to_string(kRefusedBytesKept));
    }
    return RefusedDatagram{.time = {m.wall_utime},
                           .sender = m.sender,
                           .channel = m.channel,
                           .reason = m.reason,
                           .bytes = static_cast<std::uint32_t>(m.bytes),
                           .like_it = static_cast<std::uint64_t>(m.like_it),
                           .head = m.head};
  });
}

}  // namespace palace
