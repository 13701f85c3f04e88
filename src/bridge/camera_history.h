// The newest samples of one camera, and the camera at a time between them.
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

/// The newest samples of a value, in the order of their times (ns). Allocates nothing.
template <typename Value>
class SampleRing {
 public:
  /// A second at 500 Hz.
  static constexpr std::size_t capacity = 512;

  struct Sample {
    std::int64_t time = 0;
    Value value{};
  };
  /// Where a time lies: at `before` where `part` is 0, at `after` where it is 1, beyond it where it is more.
  struct Place {
    const Sample* before;
    const Sample* after;
    double part;
    std::int64_t time;  ///< that was asked for, or the nearest one that there is
  };

  bool is_empty() const noexcept { return size_ == 0; }
  void clear() noexcept { size_ = 0; }
  /// `back` samples before the newest.
  const Sample& newest(std::size_t back = 0) const noexcept { return ring_[(end_ + capacity - 1 - back) % capacity]; }
  const Sample& oldest() const noexcept { return newest(size_ - 1); }

  /// A late one is put in its place. One of the time of another is left out, and so is one older than all of a full
  /// ring.
  void add(std::int64_t time, const Value& value) noexcept {
    std::size_t newer = 0;
    while (newer < size_ && newest(newer).time > time) ++newer;
    if (newer == capacity || (newer < size_ && newest(newer).time == time)) return;
    end_ = (end_ + 1) % capacity;
    size_ = std::min(size_ + 1, capacity);
    for (std::size_t back = 0; back < newer; ++back) at(back) = at(back + 1);
    at(newer) = {time, value};
  }

  /// Not of an empty ring. Up to `lead` ns beyond the newest it extrapolates. The samples that it does that from are
  /// half as far apart as it goes, or more: the noise of times that lie close together is not multiplied.
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

/// A time of each part of a camera, ns.
struct PartTimes {
  std::int64_t position = 0, rotation = 0, lens = 0;
};

/// Not synchronised: one thread at a time. Allocates nothing.
class CameraHistory {
 public:
  struct Found {
    camera::Camera camera;
    PartTimes times;    ///< what is found is of these
    PartTimes margins;  ///< how far the newest samples are ahead of what is asked for; negative: they are behind
  };

  bool is_empty() const noexcept { return poses_.is_empty(); }
  void clear() noexcept {
    poses_.clear();
    lenses_.clear();
  }
  std::int64_t newest() const noexcept { return poses_.newest().time; }

  /// The lens may be of another time than the pose, as a CameraInfo is; of a lens that comes again with its time only
  /// what has changed counts, from the pose's time on.
  void add(const camera::Camera&, std::int64_t time, std::int64_t lens_time) noexcept;

  /// The camera at these times; up to `lead` ns beyond the newest samples it is extrapolated, and later than that it is
  /// as it is there. None where there are no samples, or all poses are younger. A lens is as old as it needs to be.
  std::optional<Found> at(const PartTimes&, std::int64_t lead) const noexcept;

 private:
  SampleRing<Eigen::Isometry3d> poses_;
  SampleRing<camera::Lens> lenses_;
  bool lens_has_own_times_ = false;
};

}  // namespace trk_bridge::bridge
