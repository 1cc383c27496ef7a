// The program's version, as --version and reports state it. CMakeLists.txt reads it from here.
#pragma once

namespace palace {

inline constexpr const char* kProgramVersion = "0.1.0";

}  // namespace palace
