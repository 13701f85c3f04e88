// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The newest samples of one camera, and the camera interpolated between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "trk_bridge/camera/interpolation.h"
#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::bridge {

/// The newest samples of a value, ordered by time (ns). Does not allocate.
template <typename Value>
class SampleRing {
 public:
  /// One second at 500 Hz.
  static constexpr std::size_t capacity = 512;

  struct Sample {
    std::int64_t time = 0;
    Value value{};
  };
  /// Position of a time: at `before` if `part` is 0, at `after` if it is 1, extrapolated if it is larger.
  struct Place {
    const Sample* before;
    const Sample* after;
    double part;
    std::int64_t time;  ///< the requested time, or the nearest available one
  };

  bool is_empty() const noexcept { return size_ == 0; }
  void clear() noexcept { size_ = 0; }
  /// `back` samples before the newest.
  const Sample& newest(std::size_t back = 0) const noexcept { return ring_[(end_ + capacity - 1 - back) % capacity]; }
  const Sample& oldest() const noexcept { return newest(size_ - 1); }

  /// Inserts a late sample in order. Ignores a sample with the time of another one, and one older than all samples of a
  /// full ring.
  void add(std::int64_t time, const Value& value) noexcept {
    std::size_t newer = 0;
    while (newer < size_ && newest(newer).time > time) ++newer;
    if (newer == capacity || (newer < size_ && newest(newer).time == time)) return;
    end_ = (end_ + 1) % capacity;
    size_ = std::min(size_ + 1, capacity);
    for (std::size_t back = 0; back < newer; ++back) at(back) = at(back + 1);
    at(newer) = {time, value};
  }

  /// The ring must not be empty. Extrapolates up to `lead` ns beyond the newest sample, from samples that are at least
  /// half that distance apart, so that the noise of closely spaced samples is not amplified.
  Place place_of(std::int64_t time, std::int64_t lead) const noexcept {
    const auto& last = newest();
    if (time > last.time) {
      const std::int64_t beyond = std::min(time - last.time, lead);
      std::size_t back = 1;
      while (back < size_ && last.time - newest(back).time < beyond / 2) ++back;
      if (beyond == 0 || back >= size_) return {&last, &last, 0, last.time};
      return between(newest(back), last, last.time + beyond);
    }
    for (std::size_t back = 0; back < size_; ++back) {
      const auto& before = newest(back);
      if (before.time == time) return {&before, &before, 0, time};
      if (before.time < time) return between(before, newest(back - 1), time);
    }
    return {&oldest(), &oldest(), 0, oldest().time};
  }

 private:
  Sample& at(std::size_t back) noexcept { return ring_[(end_ + capacity - 1 - back) % capacity]; }
  static Place between(const Sample& before, const Sample& after, std::int64_t time) noexcept {
    return {&before, &after, static_cast<double>(time - before.time) / static_cast<double>(after.time - before.time),
            time};
  }

  std::array<Sample, capacity> ring_;
  std::size_t end_ = 0, size_ = 0;
};

/// One time for each part of a camera, ns.
struct PartTimes {
  std::int64_t position = 0, rotation = 0, lens = 0;
};

/// Not synchronised: one thread at a time. Does not allocate.
class CameraHistory {
 public:
  struct Found {
    camera::Camera camera;
    PartTimes times;    ///< the times of the returned parts
    PartTimes margins;  ///< how far the newest samples are ahead of the requested times; negative: behind
  };

  bool is_empty() const noexcept { return poses_.is_empty(); }
  void clear() noexcept {
    poses_.clear();
    lenses_.clear();
  }
  std::int64_t newest() const noexcept { return poses_.newest().time; }

  /// The lens may have another time than the pose, like a CameraInfo. If a lens repeats an earlier time, it is stored
  /// only if its values changed, with the time of the pose.
  void add(const camera::Camera&, std::int64_t time, std::int64_t lens_time) noexcept;

  /// The camera at these times, extrapolated up to `lead` ns beyond the newest samples and held constant after that.
  /// None if there are no samples, or if all poses are newer. A lens may be of any age; for times before
  /// the oldest lens, the oldest is used.
  std::optional<Found> at(const PartTimes&, std::int64_t lead) const noexcept;

 private:
  SampleRing<Eigen::Isometry3d> poses_;
  SampleRing<camera::Lens> lenses_;
  bool lens_has_own_times_ = false;
};

}  // namespace trk_bridge::bridge
