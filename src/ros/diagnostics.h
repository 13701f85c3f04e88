// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts statuses for diagnostic_updater.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "bridge/status.h"

namespace trk_bridge::ros1 {

/// Converts level, message, hardware id and values; the name stays unchanged.
void to_msg(const bridge::Status& status, diagnostic_updater::DiagnosticStatusWrapper& message);

}  // namespace trk_bridge::ros1
