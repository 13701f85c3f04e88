// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "packet.h"
#include "records.h"

namespace trk_bridge::opentrackio {
namespace {

using transport::Fault;

enum class Kind : std::uint8_t {
  object,
  objects,  // a list; the next member describes each of its elements
  values,   // a list of numbers
  number,
  whole,
  flag,
  text,
};

struct Member {
  Id parent{};
  std::string_view name;
  Kind kind{};
  double least = 0, most = 0;  // for numbers and whole numbers
};

constexpr double any = std::numeric_limits<double>::max();
constexpr double max_u32 = std::numeric_limits<std::uint32_t>::max();
constexpr double i32 = std::numeric_limits<std::int32_t>::max();
constexpr double u48 = 281474976710655.0;

constexpr std::array own_members{
    Member{Id::root, "", Kind::object},
    Member{Id::root, "sourceNumber", Kind::whole, 0, max_u32},
    Member{Id::root, "timing", Kind::object},
    Member{Id::timing, "sequenceNumber", Kind::whole, 0, max_u32},
    Member{Id::timing, "sampleTimestamp", Kind::object},
    Member{Id::timestamp, "seconds", Kind::whole, 0, u48},
    Member{Id::timestamp, "nanoseconds", Kind::whole, 0, max_u32},
    Member{Id::timing, "sampleRate", Kind::object},
    Member{Id::sample_rate, "num", Kind::whole, 1, i32},
    Member{Id::sample_rate, "denom", Kind::whole, 1, max_u32},
    Member{Id::timing, "timecode", Kind::object},
    Member{Id::timecode, "hours", Kind::whole, 0, 23},
    Member{Id::timecode, "minutes", Kind::whole, 0, 59},
    Member{Id::timecode, "seconds", Kind::whole, 0, 59},
    Member{Id::timecode, "frames", Kind::whole, 0, 119},
    Member{Id::timecode, "subFrame", Kind::whole, 0, max_u32},
    Member{Id::timecode, "dropFrame", Kind::flag},
    Member{Id::timecode, "frameRate", Kind::object},
    Member{Id::frame_rate, "num", Kind::whole, 1, i32},
    Member{Id::frame_rate, "denom", Kind::whole, 1, max_u32},
    Member{Id::root, "lens", Kind::object},
    Member{Id::lens, "pinholeFocalLength", Kind::number, 0, any},
    Member{Id::lens, "focusDistance", Kind::number, 0, any},
    Member{Id::lens, "fStop", Kind::number, 0, any},
    Member{Id::lens, "projectionOffset", Kind::object},
    Member{Id::projection_offset, "x", Kind::number, -any, any},
    Member{Id::projection_offset, "y", Kind::number, -any, any},
    Member{Id::lens, "distortionOffset", Kind::object},
    Member{Id::distortion_offset, "x", Kind::number, -any, any},
    Member{Id::distortion_offset, "y", Kind::number, -any, any},
    Member{Id::lens, "distortion", Kind::objects},
    Member{Id::distortions, "", Kind::object},
    Member{Id::distortion, "model", Kind::text},
    Member{Id::distortion, "radial", Kind::values, -any, any},
    Member{Id::distortion, "tangential", Kind::values, -any, any},
    Member{Id::root, "transforms", Kind::objects},
    Member{Id::transforms, "", Kind::object},
    Member{Id::transform, "translation", Kind::object},
    Member{Id::translation, "x", Kind::number, -any, any},
    Member{Id::translation, "y", Kind::number, -any, any},
    Member{Id::translation, "z", Kind::number, -any, any},
    Member{Id::transform, "rotation", Kind::object},
    Member{Id::rotation, "pan", Kind::number, -any, any},
    Member{Id::rotation, "tilt", Kind::number, -any, any},
    Member{Id::rotation, "roll", Kind::number, -any, any},
    Member{Id::transform, "scale", Kind::object},
    Member{Id::scale, "x", Kind::number, -any, any},
    Member{Id::scale, "y", Kind::number, -any, any},
    Member{Id::scale, "z", Kind::number, -any, any},
    Member{Id::root, "static", Kind::object},
    Member{Id::statics, "camera", Kind::object},
    Member{Id::camera, "activeSensorPhysicalDimensions", Kind::object},
    Member{Id::sensor, "width", Kind::number, 0, any},
    Member{Id::sensor, "height", Kind::number, 0, any},
    Member{Id::camera, "activeSensorResolution", Kind::object},
    Member{Id::resolution, "width", Kind::whole, 0, i32},
    Member{Id::resolution, "height", Kind::whole, 0, i32},
    Member{Id::root, "custom", Kind::object},
    Member{Id::custom, "trk", Kind::object},
    Member{Id::custom_trk, "params", Kind::object},
    Member{Id::custom_params, "matrix", Kind::values, -any, any},
    Member{Id::custom_trk, "constants", Kind::object},
};
static_assert(own_members.size() == static_cast<std::size_t>(Id::fields));

template <typename Number>
constexpr Member member_of(Id parent, const char* name, Number) noexcept {
  if constexpr (std::is_floating_point_v<Number>) return {parent, name, Kind::number, -any, any};
  using Limits = std::numeric_limits<Number>;
  return {parent, name, Kind::whole, static_cast<double>(Limits::min()), static_cast<double>(Limits::max())};
}

constexpr std::array<Member, member_count> all_members() noexcept {
  std::array<Member, member_count> all{};
  std::size_t count = 0;
  for (const Member& member : own_members) all[count++] = member;
  Id parent = Id::custom_params;
  const auto add = [&](const wire::Field& field, const auto& value) {
    all[count++] = member_of(parent, field.name, value);
  };
  const wire::CameraParams params{};
  const wire::CameraConstants constants{};
  wire::for_each_field<wire::CameraParams>(add, params);
  wire::for_each_field<wire::Euler>(add, params.euler);
  parent = Id::custom_constants;
  wire::for_each_field<wire::CameraConstants>(add, constants);
  return all;
}

constexpr std::array<Member, member_count> members = all_members();
constexpr std::size_t none = member_count;
// The counter is stored in Sample::counter.
constexpr std::size_t counter_field = [] {
  std::size_t at = static_cast<std::size_t>(Id::fields), found = 0;
  const wire::CameraParams params{};
  wire::for_each_field<wire::CameraParams>(
      [&](const wire::Field& field, const auto&) {
        if (std::string_view(field.name) == "counter") found = at;
        ++at;
      },
      params);
  return found;
}();

constexpr std::size_t index(Id id) noexcept { return static_cast<std::size_t>(id); }

std::size_t child_of(std::size_t parent, std::string_view name) noexcept {
  for (std::size_t i = 1; i < members.size(); ++i) {
    if (index(members[i].parent) == parent && members[i].name == name) return i;
  }
  return none;
}

constexpr std::string_view d_u = "Brown-Conrady D-U", u_d = "Brown-Conrady U-D";

/// Receives the events of the parser, for both encodings.
class Reader {
 public:
  Reader(Encoding encoding, Sample& into) : encoding_(encoding), into_(into) {}

  const std::optional<Fault>& fault() const noexcept { return fault_; }

  // NOLINTBEGIN(readability-identifier-naming): the library's names
  bool null() { return is_ignored() || refuse(Reason::wrong_type); }
  bool boolean(bool value) { return is_ignored() || take(Kind::flag, value ? 1 : 0, 0); }
  bool number_integer(std::int64_t value) {
    return is_ignored() || take(Kind::whole, static_cast<double>(value), static_cast<std::uint64_t>(value));
  }
  bool number_unsigned(std::uint64_t value) {
    return is_ignored() || take(Kind::whole, static_cast<double>(value), value);
  }
  bool number_float(double value, const std::string&) {
    if (is_ignored()) return true;
    if (!std::isfinite(value)) return refuse(Reason::out_of_range);
    const bool is_whole = value == std::floor(value) && value >= 0 && value < 0x1p63;
    return take(is_whole ? Kind::whole : Kind::number, value, is_whole ? static_cast<std::uint64_t>(value) : 0);
  }
  bool string(const std::string& value) {
    if (is_ignored()) return true;
    if (kind() != Kind::text) return refuse(Reason::wrong_type);
    into_.model = value == d_u   ? Model::distorted_to_undistorted
                  : value == u_d ? Model::undistorted_to_distorted
                                 : Model::other;
    return true;
  }
  bool binary(const nlohmann::json::binary_t&) { return is_ignored() || refuse(Reason::wrong_type); }
  bool start_object(std::size_t) { return open(Kind::object); }
  bool end_object() {
    --depth_;
    return true;
  }
  bool key(const std::string& name) {
    if (!frame().is_ignored) member_ = child_of(frame().member, name);
    return true;
  }
  bool start_array(std::size_t) { return open(Kind::values); }
  bool end_array() { return end_object(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) {
    if (!fault_) fault_ = fault_of(encoding_ == Encoding::json ? Reason::not_json : Reason::not_cbor);
    return false;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  struct Frame {
    std::size_t member = 0;
    bool is_ignored = false;
    std::size_t count = 0;  // elements so far
  };

  Frame& frame() noexcept { return frames_[depth_ - 1]; }
  Kind kind() const noexcept { return members[member_].kind; }

  /// Determines the member of the value that begins, and whether it is ignored.
  bool is_ignored() noexcept {
    if (depth_ == 0) {
      member_ = index(Id::root);
      return false;
    }
    Frame& in = frame();
    if (in.is_ignored) return true;
    const Kind list = members[in.member].kind;
    if (list != Kind::objects && list != Kind::values) return member_ == none;
    ++in.count;
    member_ = list == Kind::objects ? in.member + 1 : in.member;
    return in.member == index(Id::distortions) && in.count > 1;
  }

  bool refuse(Reason reason) {
    fault_ = fault_of(reason, static_cast<int>(member_));
    return false;
  }

  bool open(Kind as) {
    const bool ignored = is_ignored();
    if (depth_ == most_depth) {
      fault_ = fault_of(Reason::too_deep);
      return false;
    }
    if (!ignored) {
      const bool is_list = kind() == Kind::objects || kind() == Kind::values;
      const bool is_element = depth_ > 0 && members[frame().member].kind == Kind::values;
      if (is_element || (as == Kind::object ? kind() != Kind::object : !is_list)) return refuse(Reason::wrong_type);
      if (member_ == index(Id::transform)) begin_transform();
    }
    frames_[depth_++] = {member_, ignored, 0};
    return true;
  }

  /// Multiplies the previous transform into `base`.
  void begin_transform() {
    if (into_.transforms++ > 0) into_.base = into_.base * pose_of(into_);
    for (std::size_t i = index(Id::translation); i <= index(Id::scale_z); ++i) {
      into_.has.reset(i);
      into_.numbers[i] = 0;
    }
  }

  bool take(Kind as, double value, std::uint64_t whole) {
    const Member& member = members[member_];
    const bool takes_any = member.kind == Kind::number || member.kind == Kind::values;
    const bool is_number = as == Kind::number || as == Kind::whole;
    if (!(is_number && takes_any) && as != member.kind) return refuse(Reason::wrong_type);
    if (member.kind != Kind::flag && !(value >= member.least && value <= member.most)) {
      return refuse(Reason::out_of_range);
    }
    if (member.kind == Kind::values) return take_element(value);
    if (member_ == counter_field) into_.counter = whole;
    if (members[member_].parent == Id::scale && value != 1) into_.is_scaled = true;
    into_.set(member_, value);
    return true;
  }

  bool take_element(double value) {
    const std::size_t at = frame().count - 1;
    if (member_ == index(Id::tangential)) {
      into_.is_tangential = into_.is_tangential || value != 0;
    } else if (member_ == index(Id::radial)) {
      if (at < into_.radial.size()) into_.radial[at] = value;
      // A model with more terms is neither of the two known ones.
      if (at >= into_.radial.size() && value != 0) into_.model = Model::other;
    } else {
      if (at >= into_.matrix.size()) return refuse(Reason::out_of_range);
      into_.matrix[at] = value;
      into_.has_matrix = at + 1 == into_.matrix.size();
    }
    return true;
  }

  Encoding encoding_;
  Sample& into_;
  std::optional<Fault> fault_;
  std::array<Frame, most_depth> frames_{};
  std::size_t depth_ = 0;
  std::size_t member_ = none;  // of the next value
};

using Json = nlohmann::ordered_json;

/// The position of a member; creates the objects and lists around it.
Json& place_of(Json& document, std::size_t member) {
  if (member == index(Id::root)) return document;
  Json& parent = place_of(document, index(members[member].parent));
  if (!members[member].name.empty()) return parent[std::string(members[member].name)];
  if (parent.empty()) parent.push_back(Json::object());
  return parent.front();
}

Json number_of(const Sample& sample, std::size_t member) {
  const double value = sample.numbers[member];
  if (member == counter_field) return sample.counter;
  if (members[member].kind == Kind::flag) return value != 0;
  if (members[member].kind == Kind::whole) return static_cast<std::int64_t>(value);
  return value;
}

void write_static(const Sample& sample, const Names& names, Json& document) {
  Json& camera = place_of(document, index(Id::camera));
  camera["make"] = "trk_bridge";
  camera["model"] = "trk";
  camera["serialNumber"] = std::to_string(static_cast<std::uint64_t>(sample.number(Id::source_number)));
  camera["label"] = names.label;
}

}  // namespace

std::string path_of(std::size_t member) {
  if (member >= member_count || member == index(Id::root)) return "the sample";
  const auto parent = index(members[member].parent);
  std::string name(members[member].name);
  if (parent == index(Id::root)) return name;
  return name.empty() ? path_of(parent) : path_of(parent) + "." + name;
}

std::optional<Fault> read(std::string_view text, Encoding encoding, Sample& into) noexcept {
  into = {};
  Reader reader(encoding, into);
  const auto format =
      encoding == Encoding::json ? nlohmann::json::input_format_t::json : nlohmann::json::input_format_t::cbor;
  const bool is_good = nlohmann::json::sax_parse(text.begin(), text.end(), &reader, format);
  if (is_good) return std::nullopt;
  return reader.fault() ? reader.fault() : fault_of(encoding == Encoding::json ? Reason::not_json : Reason::not_cbor);
}

void write(const Sample& sample, const Names& names, Encoding encoding, std::string& into) {
  Json document;
  document["protocol"] = {{"name", "OpenTrackIO"}, {"version", {1, 0, 1}}};
  document["sampleId"] = names.sample_id;
  document["sourceId"] = names.source_id;
  if (sample.has_member(Id::sensor_width)) write_static(sample, names, document);
  if (sample.has_member(Id::timestamp_seconds)) place_of(document, index(Id::timing))["mode"] = "internal";
  if (sample.has_member(Id::focal_length)) {
    Json& distortion = place_of(document, index(Id::distortion));
    distortion["model"] = sample.model == Model::undistorted_to_distorted ? u_d : d_u;
    distortion["radial"] = sample.radial;
  }
  for (std::size_t i = 0; i < member_count; ++i) {
    if (sample.has[i]) place_of(document, i) = number_of(sample, i);
  }
  if (sample.has_member(Id::x)) place_of(document, index(Id::transform))["id"] = "Camera";
  if (sample.has_matrix) place_of(document, index(Id::custom_matrix)) = sample.matrix;
  into.clear();
  if (encoding == Encoding::json) {
    into = document.dump();
  } else {
    Json::to_cbor(document, nlohmann::detail::output_adapter<char, std::string>(into));
  }
}

}  // namespace trk_bridge::opentrackio
