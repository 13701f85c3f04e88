// The messages of a bag that has no index, because its recorder died or its end was lost.
//
// Reindexing by rosbag rewrites a bag in place; the recording of an accident should stay as it is. So its records are
// read here one after another (bag format 2.0) for as long as they are whole, compressed chunks as far as they can be
// unpacked.
#pragma once

#include <functional>
#include <string>

#include "reader.h"

namespace trk_bridge::bag {

/// Calls back with every connection at its first record and every whole message record after its connection's, in the
/// order of the file, for as long as `on_message` says true. It may be empty. Returns where and why the bag ends.
/// Throws BagError for a file that is no bag of format 2.0, is encrypted or cannot be read.
std::string scan_bag(const std::string& path, const std::function<void(const Connection&)>& on_connection,
                     const std::function<bool(const RawMessage&)>& on_message, cli::LongRun&);

}  // namespace trk_bridge::bag
