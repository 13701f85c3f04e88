// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "tally.h"

#include <ostream>
#include <tuple>
#include <variant>

#include "trk_bridge/wire/fields.h"

namespace trk_bridge::cli {
namespace {

constexpr double assumed_field_rate = 50;  // Hz

}  // namespace

bool Tally::Less::operator()(const Key& a, const Key& b) const noexcept {
  return std::tie(a.id, a.sender.kind, a.sender.address, a.sender.number) <
         std::tie(b.id, b.sender.kind, b.sender.address, b.sender.number);
}

std::optional<base::Order> Tally::add(const transport::Sample& sample) {
  const auto* params = std::get_if<wire::CameraParams>(&sample.record);
  if (params == nullptr) {
    ++constants_;
    return std::nullopt;
  }
  ++params_;
  const Key key{params->id, sample.sender};
  auto camera = cameras_.find(key);
  if (camera == cameras_.end()) {
    if (cameras_.size() == most_cameras) {
      ++not_checked_;
      return std::nullopt;
    }
    // Without counters, every record is new.
    const auto use = sample.has_counter ? base::CounterUse::automatic : base::CounterUse::ignore;
    camera = cameras_.try_emplace(key, assumed_field_rate, use).first;
  }
  return camera->second.classify(params->counter, wire::fingerprint(*params));
}

void Tally::summarise(const transport::SourceStatistics& source, std::ostream& out) const {
  out << "trk: received " << received() << " (" << params_ << " parameters, " << constants_ << " constants), malformed "
      << source.malformed << ", refused " << source.refused << ", kernel drops " << source.kernel_drops
      << ", overwritten " << source.overwritten << '\n';
  if (source.doubtful != 0) {
    out << "trk: " << source.doubtful << " records were accepted despite: " << source.last_doubt << '\n';
  }
  for (const auto& [key, sequence] : cameras_) {
    const auto& counts = sequence.counts();
    out << "trk: id " << key.id << " from " << transport::to_string(key.sender) << ": " << counts.accepted
        << " accepted, " << counts.lost << " lost, " << counts.duplicates << " duplicate, " << counts.late
        << " out of order, " << counts.restarts << " restarts\n";
  }
  if (not_checked_ != 0) {
    out << "trk: " << not_checked_ << " parameters of more cameras than the " << most_cameras
        << " whose counters are checked\n";
  }
}

}  // namespace trk_bridge::cli
