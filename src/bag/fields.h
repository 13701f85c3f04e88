// Video fields of a bag, before they are a take.
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

/// A video field of a bag. The constants are the take's; they stay the same.
struct Field {
  const wire::CameraConstants& constants;
  const wire::CameraParams& params;
  std::int64_t stamp = 0;  ///< ns since 1970
};
/// The error is why a take cannot hold the field: it is left out.
using FieldVisitor = std::function<tl::expected<void, std::string>(const Field&)>;

/// Visits the fields of a camera's params, with its constants, one after another. Those left out are reported on `err`.
/// Throws BagError when no field is left, and what `visit` throws.
void fields_from_params(Reader&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&,
                        const FieldVisitor& visit, std::ostream& err);
/// The same of its camera_info and tf. Their counters only number the fields. In memory are the messages of the time
/// that tf interpolates over, and by which stamps are out of order.
void fields_from_tf(Reader&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&,
                    const FieldVisitor& visit, std::ostream& err);

/// The constants of a recording, in its converter. They may change up to the first field after them; a take holds one
/// set.
class RecordedConstants {
 public:
  explicit RecordedConstants(std::optional<std::uint32_t> format) : converter_(format) {}

  /// Throws BagError for constants that describe no picture, and for a change after a field.
  void use(const wire::CameraConstants&, std::int64_t stamp);
  /// A field of the recording came.
  void note_field() noexcept { is_fixed_ = is_fixed_ || converter_.incoming() != nullptr; }

  const camera::Converter& converter() const noexcept { return converter_; }

 private:
  camera::Converter converter_;
  bool is_fixed_ = false;
};

/// Throws BagError: the chip's size is an option for bags without constants only.
[[noreturn]] void refuse_chip_options();

/// Fields that are left out, counted by reason.
class Omissions {
 public:
  void add(const std::string& reason, std::int64_t stamp);
  /// A line each: how many, the stamp of the first, and why.
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
