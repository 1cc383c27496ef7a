#include "gui/app/script.h"

namespace palace {

std::string_view DefaultMissionScript() {
  return R"(# The mission of the thesis, as a careful operator flies it.
wait state PROPOSED 60
wait seconds 2
screenshot 01-search-proposed.png
# Tune: tighten a limit, look, put it back.
click tab/Tune
wait seconds 0.5
set slad.max_slope_deg 7
wait seconds 0.5
screenshot 02-tune.png
set slad.max_slope_deg 10
wait seconds 0.5
click tab/Fly
wait state PROPOSED 30
wait seconds 1.5
# Arm the best site, look at its evidence, approve.
click site/best
wait state ARMED 5
wait item approve 20
wait seconds 1.2
screenshot 03-site-armed.png
hold approve 1.2
wait state APPROVED|DESCENDING 5
screenshot 04-approved.png
wait state DESCENDING 60
wait seconds 3
screenshot 05-descent.png
wait height 8 60
screenshot 06-descent-8m.png
wait height 4 60
screenshot 07-descent-4m.png
wait state LANDED 90
wait seconds 1
screenshot 08-landed.png
click tab/Diagnose
wait seconds 0.3
screenshot 09-diagnose.png
click tab/Fly
resize 1280 720
wait seconds 0.3
screenshot 10-landed-1280.png
expect state LANDED
quit
)";
}

std::string_view DefaultViewScript() {
  return R"(# Look at whatever comes, then leave.
wait seconds 3
screenshot 01-fly.png
click tab/Tune
wait seconds 0.3
screenshot 02-tune.png
click tab/Review
wait seconds 0.3
screenshot 03-review.png
click tab/Diagnose
wait seconds 0.3
screenshot 04-diagnose.png
quit
)";
}

}  // namespace palace
