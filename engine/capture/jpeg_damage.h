// Damage inside a JPEG, which OpenCV's decoder keeps to itself.
#pragma once

#include <string>
#include <string_view>

namespace palace {

/// What libjpeg finds wrong in the data of the picture, in its own words; empty where that is
/// nothing. Bytes that say nothing before a marker are none: some cameras fill up with them. Not
/// all damage shows: a code may be exchanged for another one.
std::string DamageInJpeg(std::string_view bytes);

}  // namespace palace
