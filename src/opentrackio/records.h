// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Converts samples to records and back (doc/opentrackio.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <Eigen/Geometry>
#include <tl/expected.hpp>

#include "fault.h"
#include "sample.h"
#include "trk_bridge/base/time_code.h"
#include "trk_bridge/camera/calibration.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/transport/sample.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::opentrackio {

/// Source numbers are 1 to this.
inline constexpr std::uint32_t highest_source = 200;

/// The pose of the last transform, without its scale.
Eigen::Isometry3d pose_of(const Sample&) noexcept;

/// What is lost because trk cannot express it; the first that applies.
enum class Lost : std::uint8_t { nothing, tangential, distortion_offset, scale, resolution };

/// The records of a sample.
struct Records {
  std::optional<wire::CameraConstants> constants;
  std::optional<wire::CameraParams> params;
  bool has_counter = false, has_lens = false;
  std::optional<std::int64_t> sample_time;  ///< ns since 1970 UTC
  std::optional<base::TimeCodeWithRate> time_code;
  Lost lost = Lost::nothing;
  std::optional<transport::Fault> fault;  ///< of one part; the others are valid
};

/// Converts samples of one port to records. Stores the sensor of each source number, and the last fit of its
/// distortion. Allocates only for new source numbers.
class RecordsReader {
 public:
  /// `takes_any`: accepts invalid source numbers (0, above 200, none). `tai_offset`: how far the clocks of the senders
  /// are ahead of UTC, s.
  RecordsReader(bool takes_any, int tai_offset) : takes_any_(takes_any), tai_offset_(tai_offset) {}

  [[nodiscard]] tl::expected<Records, transport::Fault> read(const Sample&) noexcept;

 private:
  struct Source {
    std::optional<wire::CameraConstants> constants;
    // Input and result of the last fit; none: no fit yet.
    std::array<double, 6> radial{};
    Model model{};
    Eigen::Vector2d center_shift = Eigen::Vector2d::Zero();
    std::optional<tl::expected<camera::Lens, Reason>> fitted;
  };

  tl::expected<camera::Lens, Reason> distorted(const Sample&, const camera::Lens&, Source&) noexcept;

  bool takes_any_;
  int tai_offset_;
  std::unordered_map<std::uint32_t, Source> sources_;
};

/// Receivers with special requirements.
enum class Profile : std::uint8_t { generic, unreal };

struct WriterSettings {
  Profile profile = Profile::generic;
  Model model = Model::distorted_to_undistorted;
  std::uint32_t source = 0;    ///< 1 to 200; 0: the id of the record
  int tai_offset = 37;         ///< s
  std::optional<double> rate;  ///< Hz, of samples
};

/// Converts records to samples. Fields whose value cannot be computed from the standard members are written to
/// `custom`. Stores the constants of each id, which are sent with its next parameters; allocates only for new ids.
class RecordsWriter {
 public:
  explicit RecordsWriter(const WriterSettings& settings) : settings_(settings) {}

  /// Constants are sent with the next parameters of their id.
  tl::expected<void, transport::Fault> use(const wire::CameraConstants&) noexcept;
  /// `nanoseconds` since 1970 UTC.
  tl::expected<Sample, transport::Fault> sample_of(const wire::CameraParams&, std::int64_t nanoseconds,
                                                   const std::optional<base::TimeCodeWithRate>&) noexcept;

 private:
  struct Camera {
    camera::Converter converter{wire::euler};
    camera::Calibrator calibrator;
    bool is_due = false;  // the constants
  };

  std::optional<transport::Fault> set_distortion(const camera::Lens&, Camera&, Sample&) const noexcept;

  WriterSettings settings_;
  std::unordered_map<std::uint32_t, Camera> cameras_;
};

}  // namespace trk_bridge::opentrackio
