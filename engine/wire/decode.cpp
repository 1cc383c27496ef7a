#include "engine/wire/decode.h"

#include <bit>
#include <string>
#include <type_traits>

#include "engine/wire/wire_fields.h"

namespace palace {
namespace {

/// Fewest bytes one element of a list takes: bounds a count before anything is allocated.
template <typename T>
constexpr std::size_t SmallestSize() {
  if constexpr (std::is_arithmetic_v<T>) {
    return sizeof(T);
  } else if constexpr (std::is_same_v<T, image_metadata_t>) {
    return 4 + 1 + 4;
  } else if constexpr (std::is_same_v<T, slad_setting_t>) {
    return 4 + 1 + 8;
  } else {
    static_assert(std::is_same_v<T, site_t>);
    return 8 + 1 + 8 + 4 + 4 + 8 * (3 + 3 + 2 + 4 * 2 + 5) + 4 + 4 + 1 + 1 + 8 + 4 + 1;
  }
}

class BoundedReader {
 public:
  BoundedReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (Read(fields), ...);
  }
  template <typename T>
  void List(std::int32_t count, std::vector<T>& list) {
    if (count < 0 || static_cast<std::size_t>(count) > left() / SmallestSize<T>()) {
      Fail("a list of " + std::to_string(count) + " elements does not fit the bytes left");
    }
    if (!ok()) {
      return;
    }
    const auto elements = static_cast<std::size_t>(count);
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      list.assign(data_ + at_, data_ + at_ + elements);
      at_ += elements;
    } else {
      list.resize(elements);
      for (std::size_t i = 0; i < elements && ok(); ++i) {
        Read(list[i]);
      }
    }
  }
  bool ok() const { return problem_.empty(); }
  std::size_t left() const { return size_ - at_; }
  const std::string& problem() const { return problem_; }

 private:
  void Fail(std::string problem) {
    if (ok()) {
      problem_ = std::move(problem) + " at byte " + std::to_string(at_);
    }
  }
  template <typename T>
  void Read(T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      ReadText(value);
    } else if constexpr (std::is_array_v<T>) {
      for (auto& element : value) {
        Read(element);
      }
    } else if constexpr (std::is_same_v<T, double>) {
      std::uint64_t bits = 0;
      Read(bits);
      value = std::bit_cast<double>(bits);
    } else if constexpr (std::is_integral_v<T>) {
      ReadInteger(value);
    } else {
      VisitFields(*this, value);
    }
  }
  template <typename T>
  void ReadInteger(T& value) {
    value = 0;
    if (left() < sizeof(T)) {
      Fail("the message ends early");
    }
    if (!ok()) {
      return;
    }
    std::make_unsigned_t<T> bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bits = static_cast<std::make_unsigned_t<T>>((static_cast<std::uint64_t>(bits) << 8) |
                                                  data_[at_ + i]);
    }
    value = static_cast<T>(bits);
    at_ += sizeof(T);
  }
  void ReadText(std::string& text) {
    std::int32_t length = 0;  // counts the closing zero
    Read(length);
    if (!ok()) {
      return;
    }
    const auto bytes = static_cast<std::size_t>(length);
    if (length < 1 || bytes > left() || data_[at_ + bytes - 1] != 0) {
      Fail("a text of " + std::to_string(length) + " bytes does not fit or is not closed");
      return;
    }
    text.assign(data_ + at_, data_ + at_ + bytes - 1);
    if (text.find('\0') != std::string::npos) {  // LCM writes a text up to its first zero only
      Fail("a text with a zero inside");
    }
    at_ += bytes;
  }

  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  std::string problem_;
};

}  // namespace

template <typename T>
Result<T> DecodePayload(const std::uint8_t* data, std::size_t size) {
  const std::string name = T::getTypeName();
  BoundedReader reader(data, size);
  std::int64_t hash = 0;
  reader(hash);
  if (!reader.ok() || hash != T::getHash()) {
    return InvalidError("not a " + name + ": " + kTypeHashDiffers + "; rebuild the sender from " +
                        "engine/wire/types/" + name + ".lcm");
  }
  T message{};
  VisitFields(reader, message);
  if (!reader.ok()) {
    return InvalidError("broken " + name + ": " + reader.problem());
  }
  if (reader.left() != 0) {
    return InvalidError("broken " + name + ": " + std::to_string(reader.left()) +
                        " bytes too many");
  }
  return message;
}

template <typename T>
std::vector<std::uint8_t> EncodePayload(const T& message) {
  std::vector<std::uint8_t> payload(static_cast<std::size_t>(message.getEncodedSize()));
  const int written = message.encode(payload.data(), 0, static_cast<int>(payload.size()));
  PALACE_CHECK(written == static_cast<int>(payload.size()), written, payload.size());
  return payload;
}

#define PALACE_WIRE_TYPE(type)                                                 \
  template Result<type> DecodePayload<type>(const std::uint8_t*, std::size_t); \
  template std::vector<std::uint8_t> EncodePayload<type>(const type&);

PALACE_WIRE_TYPE(abort_t)
PALACE_WIRE_TYPE(authority_t)
PALACE_WIRE_TYPE(camera_rig_t)
PALACE_WIRE_TYPE(command_ack_t)
PALACE_WIRE_TYPE(command_t)
PALACE_WIRE_TYPE(event_t)
PALACE_WIRE_TYPE(gps_t)
PALACE_WIRE_TYPE(image_t)
PALACE_WIRE_TYPE(imu_t)
PALACE_WIRE_TYPE(laser_range_t)
PALACE_WIRE_TYPE(mission_t)
PALACE_WIRE_TYPE(pose_t)
PALACE_WIRE_TYPE(position_estimate_t)
PALACE_WIRE_TYPE(refused_t)
PALACE_WIRE_TYPE(session_request_t)
PALACE_WIRE_TYPE(site_decision_t)
PALACE_WIRE_TYPE(site_proposal_t)
PALACE_WIRE_TYPE(slad_settings_t)
PALACE_WIRE_TYPE(station_status_t)
PALACE_WIRE_TYPE(tracker_status_t)
PALACE_WIRE_TYPE(arrival_t)
PALACE_WIRE_TYPE(truth_t)
PALACE_WIRE_TYPE(vehicle_status_t)

#undef PALACE_WIRE_TYPE

}  // namespace palace
