// Whether what is followed from picture to picture was found in the newest one.
#pragma once

#include <cstdint>

#include "engine/core/check.h"

namespace palace {

enum class FollowState : std::uint8_t {
  kFollowed,
  kLost,        ///< not found: where it may be is coasted
  kReacquired,  ///< followed, and lost in the picture before
};

/// "followed", "LOST", "re-acquired".
inline const char* FollowWord(FollowState state) {
  switch (state) {
    case FollowState::kFollowed:
      return "followed";
    case FollowState::kLost:
      return "LOST";
    case FollowState::kReacquired:
      return "re-acquired";
  }
  PALACE_CHECK(false);
}

}  // namespace palace
