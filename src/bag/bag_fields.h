// Video fields as a bag tells them, before they are a take.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "bag_cameras.h"
#include "bag_file.h"
#include "trk_bridge/wire/record.h"

namespace trk_bridge::bag {

struct BagToTakeOptions {
  std::optional<std::string> camera;    ///< a namespace; none: the bag's only one
  std::optional<BagInput> input;        ///< none: params where there are any
  std::optional<double> field_rate;     ///< Hz; none: as the bag says, else 50
  std::optional<std::uint32_t> format;  ///< none: params as they are, tf as euler
  std::optional<std::uint32_t> id;      ///< in place of the bag's
  std::string studio_frame = "studio";
  std::optional<std::string> camera_frame;        ///< none: the frame of camera_info
  bool camera_frame_is_optical = false;           ///< the frame of camera_info always is
  std::optional<double> chip_width, chip_height;  ///< mm, for bags without constants
  bool overwrite = false;
};

struct BagFields {
  wire::CameraConstants constants;
  std::vector<wire::CameraParams> params;
  std::vector<std::int64_t> stamps;  ///< of params, ns since 1970
  bool has_counters = true;          ///< of the sender; else they only number the fields
};

/// Why fields were left out, or what of them a take cannot tell, by reason.
class Omissions {
 public:
  void add(const std::string& reason, std::int64_t stamp);
  bool empty() const noexcept { return reasons_.empty(); }
  /// A line each: how many, why, and the stamp of the first.
  void tell(std::ostream& err) const;
  std::string first_reason() const { return reasons_.empty() ? std::string() : reasons_.front().text; }

 private:
  struct Reason {
    std::string text;
    std::uint64_t times = 0;
    std::int64_t first = 0;
  };
  std::vector<Reason> reasons_;  // few
};

/// "1700000000.020000000" of nanoseconds since 1970.
std::string stamp_text(std::int64_t nanoseconds);

/// The constants of a camera's topic: those known when the first params come, else the first ones. None when it has
/// none. Throws BagError when others come later, for a take holds one set.
class BagConstants {
 public:
  void take(const wire::CameraConstants&, std::int64_t stamp);
  void note_params() noexcept { in_use_ = in_use_ || known_.has_value(); }
  const std::optional<wire::CameraConstants>& known() const noexcept { return known_; }

 private:
  std::optional<wire::CameraConstants> known_;
  bool in_use_ = false;
};

/// Both say on `err` what was left out, and throw BagError when nothing is left.
BagFields fields_from_params(BagFile&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&, std::ostream& err);
BagFields fields_from_tf(BagFile&, const std::string& camera, const BagToTakeOptions&, cli::LongRun&, std::ostream& err);

}  // namespace trk_bridge::bag
