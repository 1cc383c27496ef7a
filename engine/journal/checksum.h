// CRC-32C (Castagnoli), reflected, as iSCSI uses it (RFC 3720, B.4).
#pragma once

#include <cstddef>
#include <cstdint>

namespace palace {

/// Continues `crc` over the bytes; start with 0. Crc32c("123456789") = 0xE3069283.
std::uint32_t Crc32c(std::uint32_t crc, const void* data, std::size_t size);

}  // namespace palace
