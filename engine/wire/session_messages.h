// Messages about who commands. For .cpp files of this room only.
#pragma once

#include <palace/authority_t.hpp>
#include <palace/session_request_t.hpp>

#include "engine/core/result.h"
#include "engine/model/vehicle_message.h"
#include "engine/model/vehicle_state.h"
#include "engine/wire/wire_message.h"

namespace palace {

session_request_t SessionRequestToWire(const SessionRequest& request);
Result<VehicleMessage> SessionRequestFromWire(const session_request_t& m);
authority_t AuthorityToWire(const AuthorityReport& report);
Result<AuthorityReport> AuthorityFromWire(const WireMessage& message);

}  // namespace palace
