// RefusalWatch: what the engine refused since the last look, so that no click is lost in silence.
#pragma once

#include <string>

#include "engine/model/snapshot.h"

namespace palace {

class RefusalWatch {
 public:
  /// The newest refusal among the events that came since the last call; empty: none, or it was
  /// refused in a recorded flight and answers nobody here.
  std::string Newest(const EngineSnapshot& snapshot);

 private:
  std::size_t seen_ = 0;
};

}  // namespace palace
