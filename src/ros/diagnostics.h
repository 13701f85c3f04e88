// Statuses as diagnostic_updater sends them.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "bridge/status.h"

namespace trk_bridge::ros1 {

/// Level, message, hardware id and values; the name stays.
void to_msg(const bridge::Status& status, diagnostic_updater::DiagnosticStatusWrapper& message);

}  // namespace trk_bridge::ros1
