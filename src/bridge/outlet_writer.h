// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Writes records to one sink in the form that the sink needs.
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

/// The id that is sent in this form for the id of a record.
constexpr std::uint32_t sent_id(const transport::SinkForm& form, std::uint32_t of_record) noexcept {
  return form.sends_id ? form.id.value_or(of_record) : 0;
}

/// Whose records a program writes to its sinks.
enum class Feed : std::uint8_t {
  passed_on,   ///< records of any number of cameras; a record that is not a valid camera is sent if the format needs no
               ///< change
  one_camera,  ///< records of one camera, whatever their ids; a record that is not a valid camera
               ///< (camera::why_not_a_camera) is dropped
};

/// Why a record was lost before it reached the sink.
enum class OutletReason : std::uint8_t {
  too_many_ids,  ///< constants of more than OutletWriter::most_ids ids: the network must not be able to use up memory
  outdated,      ///< the queue was full, and the oldest parameters were dropped for newer ones
  too_slow,      ///< the queue was full, and nothing may be dropped: the recording has ended
};
/// One line for a person.
std::string describe(OutletReason);

/// A record that was not sent.
struct Loss {
  /// It cannot be converted, the sink did not accept it, or it did not reach the sink.
  using Cause = std::variant<camera::CameraReason, transport::SinkFault, OutletReason>;

  std::uint32_t id = 0;  ///< as received; if a queue dropped records, the id of the record that was pushed
  Cause cause;
};
/// Called for every loss, in the thread where it happens.
using LossListener = std::function<void(const Loss&)>;

/// Statistics of one sink's records. Trivially copyable.
struct OutletStatistics {
  transport::SinkStatistics sent;
  std::uint64_t dropped = 0;  ///< parameters that are not a valid camera; reason of the last one: `drop_reason`
  /// Parameters that cannot be converted to the format; reason of the last one: `withhold_reason`.
  std::uint64_t withheld = 0;
  camera::CameraReason drop_reason{}, withhold_reason{};
  std::uint64_t refused_constants = 0;  ///< invalid ones (no picture is left), and those of too many ids
  std::uint32_t last_id = 0;            ///< as sent; valid once sent.params > 0
  std::uint32_t unsent_id = 0;          ///< the last id that was not sent because the receiver accepts no ids

  std::uint64_t failed_sets = 0;                                   ///< sets that were not sent completely
  bool fails = false;                                              ///< the last set was one of those
  transport::SinkFault last_fault{transport::SinkReason::closed};  ///< valid once failed_sets > 0
  std::int64_t last_failure = 0, last_success = 0;                 ///< of sets; steady clock, ns
};

/// Writes in the calling thread, one at a time; any thread may call statistics(). Allocates only for the first
/// constants of an id.
class OutletWriter {
 public:
  /// More cameras than any studio has.
  static constexpr std::size_t most_ids = 256;

  OutletWriter(std::unique_ptr<transport::Sink>, const transport::SinkForm&, Feed = Feed::passed_on, LossListener = {});

  /// Constants of the camera that sends parameters with the same id. They are sent when they change
  /// (camera::Converter::use); if that fails, it is tried again before every later set until it succeeds. If a format
  /// is set, invalid constants (no picture is left) are not sent, and parameters are converted without constants until
  /// others arrive; a datagram sink continues to repeat the last valid ones.
  void write(const wire::CameraConstants&);
  /// Converts and sends them. Without a format, all numbers stay unchanged.
  void write(const wire::CameraParams&, const transport::RecordTime& time = {});
  /// Sink::prepare.
  void prepare() { sink_->prepare(); }
  /// Sink::close.
  [[nodiscard]] transport::WriteResult close();

  /// A consistent snapshot. Any thread.
  OutletStatistics statistics() const noexcept { return published_.load(); }
  /// For the functions that any thread may call.
  const transport::Sink& sink() const noexcept { return *sink_; }

 private:
  struct Camera {
    camera::Converter converter;
    transport::WriteResult constants_written;  // the last attempt
    bool retries = false;                      // it failed, and a set was written since
  };

  std::uint32_t key(std::uint32_t id) const noexcept { return feed_ == Feed::one_camera ? 0 : id; }
  Camera* find(std::uint32_t id) noexcept;
  /// Null if there are too many ids.
  Camera* find_or_add(std::uint32_t id);
  void write_invalid(const wire::CameraConstants&, camera::CameraReason);
  void refuse(const wire::CameraConstants&, const Loss::Cause&);
  /// In the format; none if they are lost.
  std::optional<wire::CameraParams> converted(const wire::CameraParams&, const Camera*);
  /// Retries writing the camera's constants if that is due; the result of the last attempt.
  transport::WriteResult constants_before_set(Camera*);
  /// With the id of the form.
  template <typename Record, typename... Time>
  transport::WriteResult put(Record, const Time&...);
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
