// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.h"

namespace trk_bridge::ros1 {

void to_msg(const bridge::Status& status, diagnostic_updater::DiagnosticStatusWrapper& message) {
  message.summary(static_cast<unsigned char>(status.level), status.message);
  message.hardware_id = status.hardware_id;
  for (const auto& [key, value] : status.values) message.add(key, value);
}

}  // namespace trk_bridge::ros1
