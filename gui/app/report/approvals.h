// The approvals of a flight in its report: what was decided, on which evidence, and what was seen.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/report/html_page.h"
#include "engine/runtime/approval_record.h"

namespace palace {

/// A heading an approval, with its figures against their limits, and pictures beside the page:
/// approval-1.png, the left picture with the site, and approval-1-map.png. Nothing without one.
void AddApprovals(HtmlPage& page, const std::vector<ApprovalRecord>& approvals,
                  const std::filesystem::path& folder);

}  // namespace palace
