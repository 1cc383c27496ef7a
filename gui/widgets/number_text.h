// Numbers as the screen shows them: true minus, groups of three, unknown as two dashes.
#pragma once

#include <string>

#include "engine/core/time.h"

namespace palace {

/// "−1 234.5"; not finite: "––". A value that rounds to zero carries no sign.
std::string Fixed(double value, int decimals);
/// The fewest decimals, at least `least` and at most 3, that show the number as it is.
int DecimalsOf(double value, int least);
/// Fixed, with up to three decimals where a value over its limit would read like the limit: 2.298
/// with 2.3 as its least is "2.298", not "2.3". The limit is shown with its DecimalsOf.
std::string FixedAgainst(double value, double limit, bool over, int decimals);
/// "0.3 s", "12 s", "3 min".
std::string Duration(double seconds);
/// "14:32:07" of a data stamp, UTC.
std::string ClockText(Timestamp time);
/// "00:04:12".
std::string LengthText(double seconds);
/// Ages under a second as "24 ms", above as "1.8 s"; not finite: "never".
std::string AgeText(double age_s);

/// A heading as headings are read, 000 to 359: "040°"; not finite: "––°".
std::string HeadingText(double heading_rad);

}  // namespace palace
