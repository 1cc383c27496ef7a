// The program's version, as --version, reports and logs state it.
#pragma once

namespace palace {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace palace
