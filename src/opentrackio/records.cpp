// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trk_bridge/wire/format.h"

namespace trk_bridge::opentrackio {
namespace {

constexpr std::int64_t second = 1'000'000'000;
// A faulty sender may send any number of ids.
constexpr std::size_t most_cameras = 1024;

/// The stored data of an id. If there are too many ids, all data is dropped: constants are repeated.
template <typename Map>
auto& bounded(Map& all, std::uint32_t id) {
  if (all.size() >= most_cameras && all.count(id) == 0) all.clear();
  return all[id];
}

// Changes the sign because y of the sensor points down; +0 remains +0.
double negated(double value) noexcept { return 0.0 - value; }

bool is_polynomial(const std::array<double, 6>& radial) noexcept {
  return radial[1] == 0 && radial[3] == 0 && radial[4] == 0 && radial[5] == 0;
}

/// Includes k1 and k2 if the model is the polynomial of trk.
camera::Lens lens_of(const Sample& sample) noexcept {
  camera::Lens lens;
  lens.image_distance = sample.number(Id::focal_length);
  const bool has_projection = sample.has_member(Id::projection_x) || sample.has_member(Id::projection_y);
  const Id x = has_projection ? Id::projection_x : Id::distortion_x;
  const Id y = has_projection ? Id::projection_y : Id::distortion_y;
  lens.center_shift = {negated(sample.number(x)), sample.number(y)};
  if (sample.model == Model::distorted_to_undistorted && is_polynomial(sample.radial)) {
    lens.k1 = sample.radial[0];
    lens.k2 = sample.radial[2];
  }
  lens.focdist = sample.number(Id::focus_distance);
  lens.aperture = sample.number(Id::f_stop);
  return lens;
}

/// Parameters from the standard members.
wire::CameraParams params_of(const Sample& sample, const camera::Lens& lens) noexcept {
  wire::CameraParams params;
  params.id = static_cast<std::uint32_t>(sample.number(Id::source_number));
  params.format = wire::euler;
  if (sample.transforms <= 1) {
    params.euler = {sample.number(Id::x),   sample.number(Id::y),    sample.number(Id::z),
                    sample.number(Id::pan), sample.number(Id::tilt), sample.number(Id::roll)};
  } else {
    const Eigen::Isometry3d pose = sample.base * pose_of(sample);
    const camera::PanTiltRoll angles = camera::pan_tilt_roll(pose.linear());
    const Eigen::Vector3d at = pose.translation();
    params.euler = {at.x(), at.y(), at.z(), angles.pan, angles.tilt, angles.roll};
  }
  params.fov = lens.image_distance;
  params.center_x = lens.center_shift.x();
  params.center_y = lens.center_shift.y();
  params.k1 = lens.k1;
  params.k2 = lens.k2;
  params.focdist = lens.focdist;
  params.aperture = lens.aperture;
  params.counter = static_cast<std::uint64_t>(sample.number(Id::sequence_number));
  return params;
}

/// Constants from the standard members; sensor and resolution must be present.
wire::CameraConstants constants_of(const Sample& sample) noexcept {
  wire::CameraConstants constants;
  constants.id = static_cast<std::uint32_t>(sample.number(Id::source_number));
  constants.image_width = static_cast<std::int32_t>(sample.number(Id::resolution_width));
  constants.image_height = static_cast<std::int32_t>(sample.number(Id::resolution_height));
  constants.chip_width = constants.fake_chip_width = sample.number(Id::sensor_width);
  constants.chip_height = constants.fake_chip_height = sample.number(Id::sensor_height);
  return constants;
}

bool has_sensor(const Sample& sample) noexcept {
  return sample.has_member(Id::sensor_width) && sample.has_member(Id::sensor_height);
}
bool has_resolution(const Sample& sample) noexcept {
  return sample.has_member(Id::resolution_width) && sample.has_member(Id::resolution_height);
}

/// Replaces fields by those of `custom`.
template <typename Record, typename Into>
void take_custom(const Sample& sample, Into& into) noexcept {
  std::size_t at = first_field<Record>();
  wire::for_each_field<Record>(
      [&](const wire::Field&, auto& value) {
        using Value = std::decay_t<decltype(value)>;
        if (sample.has[at]) {
          value = std::is_same_v<Value, std::uint64_t> ? static_cast<Value>(sample.counter)
                                                       : static_cast<Value>(sample.numbers[at]);
        }
        ++at;
      },
      into);
}

/// Unlike ==, distinguishes 0 from -0.
template <typename Number>
bool same_bits(Number a, Number b) noexcept {
  if constexpr (std::is_floating_point_v<Number>) {
    return a == b && std::signbit(a) == std::signbit(b);
  } else {
    return a == b;
  }
}

/// Sets the fields in `custom` that a reader of the standard members would not get.
template <typename Record, typename From>
void set_custom(const From& read, const From& meant, Sample& sample) noexcept {
  std::size_t at = first_field<Record>();
  wire::for_each_field<Record>(
      [&](const wire::Field&, const auto& as_read, const auto& value) {
        using Value = std::decay_t<decltype(value)>;
        if (!same_bits<Value>(as_read, value)) {
          sample.set(at, static_cast<double>(value));
          if constexpr (std::is_same_v<Value, std::uint64_t>) sample.counter = value;
        }
        ++at;
      },
      read, meant);
}

bool has_custom_lens(const Sample& sample) noexcept {
  // A writer of custom k1 or k2 writes each one that differs; fov is a lens even without other members.
  std::size_t at = first_field<wire::CameraParams>();
  bool has = false;
  const wire::CameraParams params{};
  wire::for_each_field<wire::CameraParams>(
      [&](const wire::Field& field, const auto&) {
        const std::string_view name = field.name;
        has = has || (sample.has[at] && (name == "fov" || name == "k1" || name == "k2"));
        ++at;
      },
      params);
  return has;
}

std::optional<std::int64_t> time_of(const Sample& sample, int tai_offset) noexcept {
  if (!sample.has_member(Id::timestamp_seconds)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(sample.number(Id::timestamp_seconds)) - tai_offset;
  // Nanoseconds would overflow beyond this.
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / second - 10;
  if (whole < 0 || whole > most) return std::nullopt;
  return whole * second + static_cast<std::int64_t>(sample.number(Id::timestamp_nanoseconds));
}

/// trk counts two fields per frame at rates above 30 Hz, and frames up to this rate.
constexpr double highest_frame_rate = 30.5;

std::optional<base::TimeCodeWithRate> time_code_of(const Sample& sample) noexcept {
  for (const Id id : {Id::hours, Id::minutes, Id::seconds, Id::frames, Id::frame_rate_num, Id::frame_rate_denom}) {
    if (!sample.has_member(id)) return std::nullopt;
  }
  const auto whole = [&sample](Id id) { return static_cast<int>(sample.number(id)); };
  base::TimeCodeWithRate counted;
  counted.rate = sample.number(Id::frame_rate_num) / sample.number(Id::frame_rate_denom);
  counted.code = {whole(Id::hours),
                  whole(Id::minutes),
                  whole(Id::seconds),
                  whole(Id::frames),
                  1,
                  sample.number(Id::drop_frame) != 0};
  if (sample.has_member(Id::sub_frame)) {
    counted.rate *= 2;
    counted.code.field = sample.number(Id::sub_frame) == 0 ? 1 : 2;
  } else if (counted.rate >= highest_frame_rate) {
    counted.code.field = counted.code.frames % 2 + 1;
    counted.code.frames /= 2;
  }
  return counted;
}

struct Ratio {
  double num = 0, denom = 1;
};

Ratio ratio_of(double rate) noexcept {
  const double exact = base::exact_rate(rate);
  const double slow = std::round(exact * 1.001);
  if (exact == std::round(exact)) return {exact, 1};
  if (std::abs(exact * 1.001 - slow) < 1e-9 * slow) return {slow * 1000, 1001};
  return {std::max(1.0, std::round(exact * 1e6)), 1e6};
}

void set_time_code(const base::TimeCodeWithRate& counted, Sample& sample) noexcept {
  const bool has_fields = counted.rate >= highest_frame_rate;
  const Ratio ratio = ratio_of(has_fields ? counted.rate / 2 : counted.rate);
  sample.set(Id::hours, counted.code.hours);
  sample.set(Id::minutes, counted.code.minutes);
  sample.set(Id::seconds, counted.code.seconds);
  sample.set(Id::frames, counted.code.frames);
  if (has_fields) sample.set(Id::sub_frame, counted.code.field - 1);
  if (counted.code.drop_frame) sample.set(Id::drop_frame, 1);
  sample.set(Id::frame_rate_num, ratio.num);
  sample.set(Id::frame_rate_denom, ratio.denom);
}

/// OpenCV's coefficients are for radii in units of the image distance F, those of OpenLensIO for radii in mm: they
/// differ by a power of F. In `radial`, coefficients of numerator and denominator alternate.
struct Place {
  std::size_t radial, opencv;
  int power;  // of F
};
constexpr std::array<Place, 6> coefficient_places{{{0, 0, 2}, {2, 1, 4}, {4, 4, 6}, {1, 5, 2}, {3, 6, 4}, {5, 7, 6}}};

tl::expected<camera::Lens, Reason> fit(const Sample& sample, camera::Lens lens,
                                       const wire::CameraConstants& constants) noexcept {
  camera::Result<camera::FittedLens> fitted = tl::unexpected(camera::CameraReason::no_fit);
  if (sample.model == Model::distorted_to_undistorted) {
    const auto& r = sample.radial;
    fitted = camera::fit_lens(lens, {{r[0], r[2], r[4]}, {r[1], r[3], r[5]}}, constants);
  } else {
    std::vector<double> d(8);
    for (const Place& place : coefficient_places) {
      d[place.opencv] = sample.radial[place.radial] * std::pow(lens.image_distance, place.power);
    }
    fitted = camera::fit_lens(camera::camera_matrix(lens, constants), d, constants);
  }
  if (!fitted) return tl::unexpected(Reason::no_fit);
  lens.k1 = fitted->lens.k1;
  lens.k2 = fitted->lens.k2;
  return lens;
}

}  // namespace

Eigen::Isometry3d pose_of(const Sample& sample) noexcept {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = camera::rotation_of({sample.number(Id::pan), sample.number(Id::tilt), sample.number(Id::roll)});
  pose.translation() = Eigen::Vector3d(sample.number(Id::x), sample.number(Id::y), sample.number(Id::z));
  return pose;
}

tl::expected<camera::Lens, Reason> RecordsReader::distorted(const Sample& sample, const camera::Lens& lens,
                                                            Source& source) noexcept {
  if (sample.model == Model::other) return tl::unexpected(Reason::unknown_model);
  const bool is_exact = sample.model == Model::distorted_to_undistorted && is_polynomial(sample.radial);
  const bool is_none = std::all_of(sample.radial.begin(), sample.radial.end(), [](double k) { return k == 0; });
  if (is_exact || is_none) return lens;
  if (!source.constants) return tl::unexpected(Reason::sensor_needed);
  // The radii are mm on the sensor: the fit does not depend on the image distance.
  if (!source.fitted || source.radial != sample.radial || source.model != sample.model ||
      source.center_shift != lens.center_shift) {
    source.radial = sample.radial;
    source.model = sample.model;
    source.center_shift = lens.center_shift;
    source.fitted = fit(sample, lens, *source.constants);
  }
  if (!*source.fitted) return *source.fitted;
  camera::Lens with = lens;
  with.k1 = (*source.fitted)->k1;
  with.k2 = (*source.fitted)->k2;
  return with;
}

tl::expected<Records, transport::Fault> RecordsReader::read(const Sample& sample) noexcept {
  const auto number = static_cast<std::uint32_t>(sample.number(Id::source_number));
  if (!takes_any_ && (number < 1 || number > highest_source)) {
    return tl::unexpected(fault_of(Reason::source_number, static_cast<int>(Id::source_number)));
  }
  Source& source = bounded(sources_, number);
  Records records;
  if (sample.is_tangential) records.lost = Lost::tangential;
  if (sample.is_scaled) records.lost = Lost::scale;
  if (has_sensor(sample) && has_resolution(sample)) {
    wire::CameraConstants constants = constants_of(sample);
    take_custom<wire::CameraConstants>(sample, constants);
    if (camera::check(constants) && source.constants != constants) {
      source.constants = constants;
      source.fitted.reset();
    }
    records.constants = constants;
  } else if (has_sensor(sample)) {
    records.lost = Lost::resolution;
  }
  if (sample.transforms == 0) {
    if (!records.constants) return tl::unexpected(fault_of(Reason::empty_sample));
    return records;
  }
  camera::Lens lens = lens_of(sample);
  records.has_lens = lens.image_distance > 0;
  if (records.has_lens && sample.has_member(Id::projection_x) && sample.has_member(Id::distortion_x) &&
      (sample.number(Id::projection_x) != sample.number(Id::distortion_x) ||
       sample.number(Id::projection_y) != sample.number(Id::distortion_y))) {
    records.lost = Lost::distortion_offset;
  }
  if (has_custom_lens(sample)) {
    records.has_lens = true;
  } else if (records.has_lens) {
    const auto with = distorted(sample, lens, source);
    if (with) lens = *with;
    if (!with) records.fault = fault_of(with.error(), static_cast<int>(Id::distortion));
    records.has_lens = with.has_value();
  }
  wire::CameraParams params = params_of(sample, lens);
  const wire::Euler& euler = params.euler;
  if (!std::isfinite(euler.x + euler.y + euler.z + euler.pan + euler.tilt + euler.roll)) {
    return tl::unexpected(fault_of(Reason::out_of_range, static_cast<int>(Id::transforms)));
  }
  take_custom<wire::CameraParams>(sample, params);
  if (wire::has(params.format, wire::euler)) {
    take_custom<wire::Euler>(sample, params.euler);
  } else {
    if (!sample.has_matrix) return tl::unexpected(fault_of(Reason::missing, static_cast<int>(Id::custom_matrix)));
    params.matrix = sample.matrix;
    params.euler = {};
  }
  records.params = params;
  records.has_counter = sample.has_member(Id::sequence_number);
  records.sample_time = time_of(sample, tai_offset_);
  records.time_code = time_code_of(sample);
  return records;
}

tl::expected<void, transport::Fault> RecordsWriter::use(const wire::CameraConstants& constants) noexcept {
  if (const auto checked = camera::check(constants); !checked) return tl::unexpected(fault_of(checked.error()));
  Camera& camera = bounded(cameras_, constants.id);
  (void)camera.converter.use(constants);
  camera.is_due = true;
  return {};
}

std::optional<transport::Fault> RecordsWriter::set_distortion(const camera::Lens& lens, Camera& camera,
                                                              Sample& sample) const noexcept {
  sample.model = settings_.model;
  if (sample.model == Model::distorted_to_undistorted) {
    sample.radial = {lens.k1, 0, lens.k2, 0, 0, 0};
    return std::nullopt;
  }
  if (lens.k1 == 0 && lens.k2 == 0) return std::nullopt;
  if (camera.converter.incoming() == nullptr) return fault_of(camera::CameraReason::constants_needed);
  const auto calibration = camera.calibrator.calibrate(lens, *camera.converter.incoming());
  if (!calibration) return fault_of(calibration.error());
  for (const Place& place : coefficient_places) {
    sample.radial[place.radial] = calibration->distortion.d[place.opencv] / std::pow(lens.image_distance, place.power);
  }
  return std::nullopt;
}

tl::expected<Sample, transport::Fault> RecordsWriter::sample_of(
    const wire::CameraParams& params, std::int64_t nanoseconds,
    const std::optional<base::TimeCodeWithRate>& time_code) noexcept {
  const std::uint32_t number = settings_.source != 0 ? settings_.source : params.id;
  if (number < 1 || number > highest_source) return tl::unexpected(fault_of(Reason::no_source_number));
  Camera& camera = bounded(cameras_, params.id);
  const camera::Converted converted = camera.converter.convert(params);
  if (const auto why = camera::why_not_a_camera(converted)) return tl::unexpected(fault_of(*why));
  if (!converted.params) return tl::unexpected(fault_of(converted.params.error()));

  Sample sample;
  sample.set(Id::source_number, number);
  sample.set(Id::sequence_number, static_cast<double>(params.counter & 0xFFFFU));
  const std::int64_t tai = nanoseconds + settings_.tai_offset * second;
  const std::int64_t whole_seconds = tai / second, rest = tai % second;
  sample.set(Id::timestamp_seconds, static_cast<double>(whole_seconds));
  sample.set(Id::timestamp_nanoseconds, static_cast<double>(rest));
  if (settings_.rate) {
    const Ratio ratio = ratio_of(*settings_.rate);
    sample.set(Id::sample_rate_num, ratio.num);
    sample.set(Id::sample_rate_denom, ratio.denom);
  }
  if (time_code && (time_code->rate > 0 || settings_.rate)) {
    set_time_code({time_code->code, time_code->rate > 0 ? time_code->rate : *settings_.rate}, sample);
  }

  const wire::Euler& euler = converted.params->euler;
  sample.transforms = 1;
  sample.set(Id::x, euler.x);
  sample.set(Id::y, euler.y);
  sample.set(Id::z, euler.z);
  sample.set(Id::pan, euler.pan);
  sample.set(Id::tilt, euler.tilt);
  sample.set(Id::roll, euler.roll);

  if (converted.lens) {
    const camera::Lens& lens = *converted.lens;
    const double x = negated(converted.params->center_x), y = converted.params->center_y;
    sample.set(Id::focal_length, converted.params->fov);
    sample.set(Id::projection_x, x);
    sample.set(Id::projection_y, y);
    if (settings_.profile == Profile::unreal) {
      sample.set(Id::distortion_x, x);
      sample.set(Id::distortion_y, y);
    }
    if (lens.focdist > 0) sample.set(Id::focus_distance, lens.focdist);
    if (lens.aperture > 0) sample.set(Id::f_stop, lens.aperture);
    if (const auto fault = set_distortion(lens, camera, sample)) return tl::unexpected(*fault);
  }

  const wire::CameraParams read = params_of(sample, lens_of(sample));
  set_custom<wire::CameraParams>(read, params, sample);
  if (wire::has(params.format, wire::euler)) {
    set_custom<wire::Euler>(read.euler, params.euler, sample);
  } else {
    sample.matrix = params.matrix;
    sample.has_matrix = true;
  }

  if (const wire::CameraConstants* constants = camera.converter.incoming(); constants != nullptr && camera.is_due) {
    sample.set(Id::sensor_width, constants->chip_width);
    sample.set(Id::sensor_height, constants->chip_height);
    sample.set(Id::resolution_width, constants->image_width - constants->blank_left - constants->blank_right);
    sample.set(Id::resolution_height, constants->image_height - constants->blank_top - constants->blank_bottom);
    set_custom<wire::CameraConstants>(constants_of(sample), *constants, sample);
    camera.is_due = false;
  }
  return sample;
}

}  // namespace trk_bridge::opentrackio
