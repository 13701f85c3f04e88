// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Counts of received records by camera and sender, for the summary at the end of a program.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>

#include "trk_bridge/base/sequence.h"
#include "trk_bridge/transport/source.h"

namespace trk_bridge::cli {

/// Not synchronised. Allocates only for a new camera.
class Tally {
 public:
  /// The order of the counter; none for constants, and for cameras beyond `most_cameras`.
  std::optional<base::Order> add(const transport::Sample&);

  /// Parameters and constants.
  std::uint64_t received() const noexcept { return params_ + constants_; }

  struct Key {
    std::uint32_t id = 0;
    transport::Sender sender;
  };
  struct Less {
    bool operator()(const Key&, const Key&) const noexcept;
  };
  const std::map<Key, base::Sequence, Less>& cameras() const noexcept { return cameras_; }

  /// One line about the source, then one per camera: `trk: id 7 from 192.0.2.7:5000: 100 accepted, 3 lost, …`.
  void summarise(const transport::SourceStatistics&, std::ostream&) const;

  /// Cameras whose counters are checked; records of more cameras, as a port scan could produce, are only counted.
  static constexpr std::size_t most_cameras = 256;

 private:
  std::map<Key, base::Sequence, Less> cameras_;
  std::uint64_t params_ = 0, constants_ = 0, not_checked_ = 0;
};

}  // namespace trk_bridge::cli
