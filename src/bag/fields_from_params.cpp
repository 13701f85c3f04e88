#include <ostream>
#include <string>

#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "fields.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

struct Recorded {
  RecordedConstants constants;
  std::vector<wire::CameraParams> params;
  std::vector<std::int64_t> stamps;
};

Recorded read(Reader& bag, const std::string& camera, std::optional<std::uint32_t> format) {
  const std::string params_topic = topic_of(camera, "params");
  const std::string constants_topic = topic_of(camera, "constants");
  has_topic<trk_bridge::CameraParams>(bag.connections(), params_topic);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), constants_topic);
  Recorded recorded{RecordedConstants(format), {}, {}};
  const auto wanted = [&](const Connection& connection) {
    return connection.topic == params_topic || connection.topic == constants_topic;
  };
  bag.read(wanted, [&](const RawMessage& raw) {
    if (raw.connection.topic == constants_topic) {
      const auto message = message_of<trk_bridge::CameraConstants>(raw);
      recorded.constants.use(ros1::from_msg(message), stamp_of(message));
      return;
    }
    const auto message = message_of<trk_bridge::CameraParams>(raw);
    recorded.constants.note_field();
    recorded.params.push_back(ros1::from_msg(message));
    recorded.stamps.push_back(stamp_of(message));
  });
  return recorded;
}

/// The one id of all parameters.
std::uint32_t common_id(const std::vector<wire::CameraParams>& all) {
  const std::uint32_t id = all.front().id;
  for (const auto& params : all) {
    if (params.id == id) continue;
    throw BagError("parameters of several cameras, ids " + std::to_string(id) + " and " + std::to_string(params.id) +
                   ": a take holds one; --id N writes all of them as camera N");
  }
  return id;
}

/// Constants with 0 serve any camera.
std::uint32_t constants_id(std::uint32_t known, std::uint32_t id, std::ostream& err) {
  if (known == 0 || known == id) return known;
  err << "trk: the constants have id " << known << ", the parameters " << id << ": both are written with " << id
      << '\n';
  return id;
}

/// In the take's format and with its id; the error is why the take cannot hold them.
tl::expected<wire::CameraParams, std::string> params_for_take(const wire::CameraParams& recorded,
                                                              const camera::Converter& converter, std::uint32_t id) {
  auto params = converter.convert(recorded).params;
  if (!params) {
    return tl::unexpected("cannot be converted to \"" + wire::format_to_words(*converter.format()) +
                          "\": " + camera::describe(params.error()));
  }
  params->id = id;
  wire::Buffer buffer;
  if (const auto text = wire::to_text(*params, buffer); !text) return tl::unexpected(wire::describe(text.error()));
  return *params;
}

}  // namespace

Fields fields_from_params(Reader& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                          std::ostream& err) {
  const Recorded recorded = read(bag, camera, options.format);
  if (recorded.params.empty()) throw BagError("there is no message on " + topic_of(camera, "params"));
  const camera::Converter& converter = recorded.constants.converter();
  if (converter.outgoing() == nullptr) {
    throw BagError("there is no message on " + topic_of(camera, "constants") +
                   ": a take begins with constants; record them as well (they are latched)");
  }
  if (options.chip_width || options.chip_height) refuse_chip_options();
  Fields fields;
  fields.constants = *converter.outgoing();
  const std::uint32_t id = options.id ? *options.id : common_id(recorded.params);
  run.end();
  fields.constants.id = options.id ? id : constants_id(fields.constants.id, id, err);
  Omissions omissions;
  run.begin("converting");
  for (std::size_t i = 0; i < recorded.params.size(); ++i) {
    run.at(static_cast<double>(i) / static_cast<double>(recorded.params.size()));
    const auto params = params_for_take(recorded.params[i], converter, id);
    if (!params) {
      omissions.add(params.error(), recorded.stamps[i]);
      continue;
    }
    fields.params.push_back(*params);
    fields.stamps.push_back(recorded.stamps[i]);
  }
  run.end();
  omissions.report(err);
  if (fields.params.empty()) throw BagError("no field is left of " + topic_of(camera, "params"));
  return fields;
}

}  // namespace trk_bridge::bag
