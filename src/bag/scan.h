// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads the messages of a bag without an index, because its recorder crashed or its end was lost.
//
// `rosbag reindex` rewrites a bag in place, but a damaged recording should stay unchanged. So its records are read one
// after another (bag format 2.0) as long as they are complete, and compressed chunks as far as they can be unpacked.
#pragma once

#include <functional>
#include <string>

#include "reader.h"

namespace trk_bridge::bag {

/// Calls back with every connection at its first record, and with every complete message after the record of its
/// connection, in file order, until `on_message` returns false. `on_message` may be empty. Returns where and why the
/// bag ends. Throws BagError for a file that is not a bag of format 2.0, is encrypted or cannot be read.
std::string scan_bag(const std::string& path, const std::function<void(const Connection&)>& on_connection,
                     const std::function<bool(const RawMessage&)>& on_message, cli::LongRun&);

}  // namespace trk_bridge::bag
