// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Reads the video fields of a bag for conversion to a take.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "convert.h"
#include "reader.h"
#include "trk_bridge/camera/converter.h"

namespace trk_bridge::bag {

/// A video field of a bag. The constants are those of the take and do not change.
struct Field {
  const wire::CameraConstants& constants;
  const wire::CameraParams& params;
  std::int64_t stamp = 0;  ///< ns since 1970
};
/// The error is the reason why a take cannot hold the field, which is then omitted.
using FieldVisitor = std::function<tl::expected<void, std::string>(const Field&)>;

/// Visits the fields of a camera's params in order, with its constants. Omissions are reported on `err`. Throws
/// BagError if no field is left, and what `visit` throws.
void fields_from_params(Reader&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&,
                        const FieldVisitor& visit, std::ostream& err);
/// The same for its camera_info and tf. The counters number the fields. Keeps only the messages of the time span over
/// which tf interpolates and by which stamps are out of order in memory.
void fields_from_tf(Reader&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&,
                    const FieldVisitor& visit, std::ostream& err);

/// The constants of a recording, in its converter. They may change until the first field after them, because a take
/// holds one set.
class RecordedConstants {
 public:
  explicit RecordedConstants(std::optional<std::uint32_t> format) : converter_(format) {}

  /// Throws BagError for invalid constants (they describe no picture), and for a change after a field.
  void use(const wire::CameraConstants&, std::int64_t stamp);
  /// Call for every field of the recording.
  void note_field() noexcept { is_fixed_ = is_fixed_ || converter_.incoming() != nullptr; }

  const camera::Converter& converter() const noexcept { return converter_; }

 private:
  camera::Converter converter_;
  bool is_fixed_ = false;
};

/// Throws BagError: the options for the chip size are for bags without constants only.
[[noreturn]] void refuse_chip_options();

/// Omitted fields, counted by reason.
class Omissions {
 public:
  void add(const std::string& reason, std::int64_t stamp);
  /// One line per reason: how many, the stamp of the first, and the reason.
  void report(std::ostream& err) const;

 private:
  struct Reason {
    std::string text;
    std::uint64_t times = 0;
    std::int64_t first = 0;
  };
  std::vector<Reason> reasons_;  // few
};

}  // namespace trk_bridge::bag
