// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "counted_source.h"

#include <variant>

#include "base/system_text.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::transport {

Event CountedSource::sample(const Sample& sample) noexcept {
  ++counts_.records;
  if (*sample.doubt != '\0') {
    ++counts_.doubtful;
    counts_.last_doubt = sample.doubt;
  }
  const auto* params = std::get_if<wire::CameraParams>(&sample.record);
  if (params != nullptr && (params->format & ~wire::known_format_bits) != 0) ++counts_.unknown_format_bits;
  published_.store(counts_);
  return Event::sample;
}

Event CountedSource::malformed() noexcept {
  ++counts_.malformed;
  published_.store(counts_);
  return Event::malformed;
}

void CountedSource::refused(const Sender& sender) noexcept {
  ++counts_.refused;
  counts_.last_refused = sender;
  published_.store(counts_);
}

Event CountedSource::ended() noexcept {
  if (counts_.end == Event::ended) return Event::ended;
  counts_.end = Event::ended;
  published_.store(counts_);
  return Event::ended;
}

Event CountedSource::failed(int error) noexcept {
  counts_.end = Event::failed;
  counts_.error = error;
  published_.store(counts_);
  return Event::failed;
}

SourceStatistics CountedSource::statistics() const {
  const Counts counts = published_.load();
  SourceStatistics statistics;
  statistics.records = counts.records;
  statistics.malformed = counts.malformed;
  statistics.refused = counts.refused;
  statistics.unknown_format_bits = counts.unknown_format_bits;
  statistics.doubtful = counts.doubtful;
  statistics.last_doubt = counts.last_doubt;
  statistics.last_refused = counts.last_refused;
  if (counts.end == Event::failed) {
    statistics.state = SourceState::failed;
    statistics.error = name_ + ": " + base::system_text(counts.error);
  } else if (counts.end == Event::ended) {
    statistics.state = SourceState::ended;
  } else if (counts.records > 0) {
    statistics.state = SourceState::receiving;
  } else if (counts.malformed > 0) {
    statistics.state = SourceState::nothing_valid;
  } else if (counts.refused > 0) {
    statistics.state = SourceState::only_refused;
  }
  complete(statistics);
  return statistics;
}

}  // namespace trk_bridge::transport
