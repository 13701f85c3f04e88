// One sink with its form: records as they came in, converted records out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "trk_bridge/base/snapshot.h"
#include "trk_bridge/camera/converter.h"
#include "trk_bridge/transport/endpoint.h"

namespace trk_bridge::bridge {

/// The id that is sent in this form for a record's own id.
constexpr std::uint32_t sent_id(const transport::SinkForm& form, std::uint32_t of_record) noexcept {
  return form.sends_id ? form.id.value_or(of_record) : 0;
}

/// Whose records a program writes to its sinks.
enum class Feed : std::uint8_t {
  passed_on,   ///< of as many cameras as there are ids; what is no camera is sent where the format needs no change
  one_camera,  ///< of one camera, whatever their ids; what is no camera (camera::why_not_a_camera) is dropped
};

/// Why a record was lost before the sink.
enum class OutletReason : std::uint8_t {
  too_many_ids,  ///< constants of more than OutletWriter::most_ids ids: the network is not trusted with memory
  outdated,      ///< the queue was full and the oldest parameters made room for newer ones
  too_slow,      ///< the queue was full and nothing may be dropped: the recording has ended
};
/// One line for a person.
std::string describe(OutletReason);

/// A record that did not go out.
struct Loss {
  /// Cannot be converted, was not taken by the sink, or did not come as far as that.
  using Cause = std::variant<camera::CameraReason, transport::SinkFault, OutletReason>;

  std::uint32_t id = 0;  ///< as it came; where a queue made room, that of the record which it was made for
  Cause cause;
};
/// Is called for every loss in the thread that met it.
using LossListener = std::function<void(const Loss&)>;

/// What became of one sink's records so far. Trivially copyable.
struct OutletStatistics {
  transport::SinkStatistics sent;
  std::uint64_t dropped = 0;   ///< parameters that are no camera at all; `drop_reason` says why the last one was not
  std::uint64_t withheld = 0;  ///< parameters that cannot be converted to the format; `withhold_reason`
  camera::CameraReason drop_reason{}, withhold_reason{};
  std::uint64_t refused_constants = 0;  ///< those that leave no picture, and those of too many ids
  std::uint32_t last_id = 0;            ///< as sent; valid once sent.params > 0
  std::uint32_t left_out_id = 0;        ///< the last one that was not sent because the receiver takes none

  std::uint64_t failed_sets = 0;                                   ///< sets of which something did not go out
  bool fails = false;                                              ///< the last set was such
  transport::SinkFault last_fault{transport::SinkReason::closed};  ///< valid once failed_sets > 0
  std::int64_t last_failure = 0, last_success = 0;                 ///< of sets; steady clock, ns
};

/// Writes in the thread that calls it, one at a time but for statistics(). Allocates only when constants of an id come
/// for the first time.
class OutletWriter {
 public:
  /// More cameras than any studio has.
  static constexpr std::size_t most_ids = 256;

  OutletWriter(std::unique_ptr<transport::Sink>, const transport::SinkForm&, Feed = Feed::passed_on, LossListener = {});

  /// Constants of the camera that the parameters with the same id come from. They go out when they are new
  /// (camera::Converter::use); those that could not be written go again before every later set until they could. Where
  /// there is a format, constants that leave no picture are not sent, and parameters are converted without any until
  /// others come; a datagram sink goes on repeating the last sound ones.
  void write(const wire::CameraConstants&);
  /// Converts and sends them. Without a format all numbers stay as they came.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  /// Sink::prepare.
  void prepare() { sink_->prepare(); }
  /// Ends the sink in order.
  [[nodiscard]] transport::Written close();

  /// A consistent snapshot. Any thread.
  OutletStatistics statistics() const noexcept { return published_.load(); }
  /// For what any thread may ask it.
  const transport::Sink& sink() const noexcept { return *sink_; }

 private:
  struct Camera {
    camera::Converter converter;
    transport::Written constants_written;  // the last attempt
    bool retries = false;                  // it failed, and a set has come since
  };

  std::uint32_t key(std::uint32_t id) const noexcept { return feed_ == Feed::one_camera ? 0 : id; }
  Camera* find(std::uint32_t id) noexcept;
  /// Null where there are too many.
  Camera* find_or_add(std::uint32_t id);
  void write_unsound(const wire::CameraConstants&, camera::CameraReason);
  void refuse(const wire::CameraConstants&, const Loss::Cause&);
  /// In the format; none where they are lost.
  std::optional<wire::CameraParams> converted(const wire::CameraParams&, const Camera*);
  /// The last attempt to write the camera's constants, after another one where that is due.
  transport::Written constants_before_set(Camera*);
  /// With the id of the form.
  template <typename Record, typename... Time>
  transport::Written put(Record, const Time&...);
  void lose(std::uint32_t id, const Loss::Cause&) const;
  void publish() noexcept;

  const std::unique_ptr<transport::Sink> sink_;
  const transport::SinkForm form_;
  const Feed feed_;
  const LossListener listener_;
  const camera::Converter without_constants_;
  std::map<std::uint32_t, Camera> cameras_;
  OutletStatistics statistics_;
  base::Snapshot<OutletStatistics> published_;
};

}  // namespace trk_bridge::bridge
