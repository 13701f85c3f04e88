#include <ostream>
#include <string>

#include <trk_bridge/CameraConstants.h>
#include <trk_bridge/CameraParams.h>

#include "bag_fields.h"
#include "trk_bridge/camera/camera.h"
#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/codec.h"
#include "trk_bridge/wire/format.h"

namespace trk_bridge::bag {
namespace {

struct Recorded {
  BagConstants constants;
  std::vector<wire::CameraParams> params;
  std::vector<std::int64_t> stamps;
};

Recorded read(BagFile& bag, const std::string& camera) {
  const std::string params_topic = topic_of(camera, "params");
  const std::string constants_topic = topic_of(camera, "constants");
  has_topic<trk_bridge::CameraParams>(bag.connections(), params_topic);
  has_topic<trk_bridge::CameraConstants>(bag.connections(), constants_topic);
  Recorded recorded;
  const auto wanted = [&](const BagConnection& connection) {
    return connection.topic == params_topic || connection.topic == constants_topic;
  };
  bag.read(wanted, [&](const BagMessage& raw) {
    if (raw.connection.topic == constants_topic) {
      const auto message = message_of<trk_bridge::CameraConstants>(raw);
      recorded.constants.take(ros1::from_msg(message), static_cast<std::int64_t>(message.header.stamp.toNSec()));
      return;
    }
    const auto message = message_of<trk_bridge::CameraParams>(raw);
    recorded.constants.note_params();
    recorded.params.push_back(ros1::from_msg(message));
    recorded.stamps.push_back(static_cast<std::int64_t>(message.header.stamp.toNSec()));
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

}  // namespace

BagFields fields_from_params(BagFile& bag, const std::string& camera, const BagToTakeOptions& options, cli::LongRun& run,
                             std::ostream& err) {
  Recorded recorded = read(bag, camera);
  if (recorded.params.empty()) throw BagError("there is no message on " + topic_of(camera, "params"));
  if (!recorded.constants.known()) {
    throw BagError("there is no message on " + topic_of(camera, "constants") +
                   ": a take begins with constants; record them as well (they are latched)");
  }
  if (options.chip_width || options.chip_height) {
    throw BagError("--chip-width, --chip-height: for bags without constants; this one has them");
  }
  BagFields fields;
  const auto& incoming = *recorded.constants.known();
  const std::uint32_t id = options.id ? *options.id : common_id(recorded.params);
  fields.constants = options.format ? camera::constants_for(incoming, *options.format) : incoming;
  const wire::CameraConstants outgoing = fields.constants;
  fields.constants.id = options.id ? id : constants_id(incoming.id, id, err);
  Omissions omissions;
  wire::Buffer buffer;
  run.begin("converting");
  for (std::size_t i = 0; i < recorded.params.size(); ++i) {
    run.at(static_cast<double>(i) / static_cast<double>(recorded.params.size()));
    wire::CameraParams params = recorded.params[i];
    if (options.format) {
      const auto told = camera::reexpress(params, *options.format, &incoming, &outgoing);
      if (!told) {
        omissions.add(
            "cannot be told as \"" + wire::format_to_words(*options.format) + "\": " + camera::describe(told.error()),
            recorded.stamps[i]);
        continue;
      }
      params = *told;
    }
    params.id = id;
    if (const auto text = wire::to_text(params, buffer); !text) {
      omissions.add(wire::describe(text.error()), recorded.stamps[i]);
      continue;
    }
    fields.params.push_back(params);
    fields.stamps.push_back(recorded.stamps[i]);
  }
  run.end();
  omissions.tell(err);
  if (fields.params.empty()) throw BagError("no field is left of " + topic_of(camera, "params"));
  return fields;
}

}  // namespace trk_bridge::bag
