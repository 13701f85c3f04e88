// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <system_error>

namespace trk_bridge::base {

/// What the system says about a value of errno, like strerror(), but safe in several threads.
inline std::string system_text(int error_number) { return std::generic_category().message(error_number); }

}  // namespace trk_bridge::base
