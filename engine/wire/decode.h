// Bounded decoding of the generated LCM types.
//
// The generated decoders trust the counts they read: they allocate gigabytes, throw, or run past
// the end (reference: reliability 1.4). These check every count against the bytes that are left
// before anything is allocated, and refuse bytes left over. Any input gives a value or an Error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"

namespace palace {

/// In the message of every error for another type, or another version of the type.
inline constexpr const char* kTypeHashDiffers = "the type hash differs";

/// T is a generated type of engine/wire/types; instantiated for all of them in decode.cpp.
template <typename T>
Result<T> DecodePayload(const std::uint8_t* data, std::size_t size);

template <typename T>
Result<T> DecodePayload(const std::vector<std::uint8_t>& payload) {
  return DecodePayload<T>(payload.data(), payload.size());
}

/// Type hash and fields, as LCM sends them.
template <typename T>
std::vector<std::uint8_t> EncodePayload(const T& message);

}  // namespace palace
