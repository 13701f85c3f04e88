// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <ostream>
#include <string>

#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "fields.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

/// The last constants of the recording, in their converter; none if there is no message. A change after a field is
/// detected later, when the fields are read.
camera::Converter recorded_constants(Reader& bag, const std::string& topic, std::optional<std::uint32_t> format) {
  RecordedConstants constants(format);
  bag.read([&](const Connection& connection) { return connection.topic == topic; },
           [&](const RawMessage& raw) {
             const auto message = message_of<trk_bridge::CameraConstants>(raw);
             constants.use(ros1::from_msg(message), stamp_of(message));
           });
  return constants.converter();
}

/// Converts messages to fields with the format and id of the take.
class ParamsConversion {
 public:
  ParamsConversion(const camera::Converter& converter, std::optional<std::uint32_t> id)
      : converter_(converter), id_(id), constants_(*converter.outgoing()), recorded_id_(constants_.id) {
    if (id) constants_.id = *id;
  }

  /// The error is the reason why the take cannot hold it. Throws BagError for parameters of another camera.
  tl::expected<void, std::string> pass(const wire::CameraParams& recorded, std::int64_t stamp,
                                       const FieldVisitor& visit) {
    if (!first_id_) begin(recorded.id);
    if (!id_ && recorded.id != *first_id_) {
      throw BagError("parameters of several cameras, ids " + std::to_string(*first_id_) + " and " +
                     std::to_string(recorded.id) + ": a take holds one; --id N writes all of them as camera N");
    }
    auto params = converter_.convert(recorded).params;
    if (!params) {
      return tl::unexpected("cannot be converted to \"" + wire::format_to_words(*converter_.format()) +
                            "\": " + camera::describe(params.error()));
    }
    params->id = id_.value_or(*first_id_);
    return visit({constants_, *params, stamp});
  }

  void report(std::ostream& err) const {
    if (!first_id_ || id_ || recorded_id_ == constants_.id) return;
    err << "trk: the constants have id " << recorded_id_ << ", the parameters " << *first_id_
        << ": both are written with " << *first_id_ << '\n';
  }

 private:
  void begin(std::uint32_t id) {
    first_id_ = id;
    // Constants with id 0 are valid for any camera.
    if (!id_ && recorded_id_ != 0) constants_.id = id;
  }

  const camera::Converter& converter_;
  const std::optional<std::uint32_t> id_;
  wire::CameraConstants constants_;
  const std::uint32_t recorded_id_;
  std::optional<std::uint32_t> first_id_;
};

}  // namespace

void fields_from_params(Reader& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                        const FieldVisitor& visit, std::ostream& err) {
  const std::string params_topic = topic_of(camera, "params");
  const std::string constants_topic = topic_of(camera, "constants");
  has_topic<trk_bridge::CameraParams>(bag.connections(), params_topic);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), constants_topic);
  const camera::Converter converter = recorded_constants(bag, constants_topic, options.format);
  if (converter.outgoing() == nullptr) {
    throw BagError("there is no message on " + constants_topic +
                   ": a take begins with constants; record them as well (they are latched)");
  }
  if (options.chip_width || options.chip_height) refuse_chip_options();
  RecordedConstants order(options.format);
  ParamsConversion conversion(converter, options.id);
  Omissions omissions;
  std::uint64_t messages = 0, fields = 0;
  bag.read(
      [&](const Connection& connection) {
        return connection.topic == params_topic || connection.topic == constants_topic;
      },
      [&](const RawMessage& raw) {
        if (raw.connection.topic == constants_topic) {
          const auto message = message_of<trk_bridge::CameraConstants>(raw);
          order.use(ros1::from_msg(message), stamp_of(message));
          return;
        }
        const auto message = message_of<trk_bridge::CameraParams>(raw);
        order.note_field();
        ++messages;
        const auto passed = conversion.pass(ros1::from_msg(message), stamp_of(message), visit);
        if (passed)
          ++fields;
        else
          omissions.add(passed.error(), stamp_of(message));
      });
  run.end();
  conversion.report(err);
  omissions.report(err);
  if (messages == 0) throw BagError("there is no message on " + params_topic);
  if (fields == 0) throw BagError("no field is left of " + params_topic);
}

}  // namespace trk_bridge::bag
