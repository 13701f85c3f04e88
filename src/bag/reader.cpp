#include "reader.h"

#include <utility>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "scan.h"

namespace trk_bridge::bag {
namespace {

Connection connection_of(const rosbag::ConnectionInfo& info) {
  Connection connection;
  connection.id = info.id;
  connection.topic = info.topic;
  connection.type = info.datatype;
  connection.md5sum = info.md5sum;
  if (info.header) connection.header.insert(info.header->begin(), info.header->end());
  return connection;
}

}  // namespace

Reader::Reader(std::string path, cli::LongRun& run) : path_(std::move(path)), run_(run) {
  run_.begin("reading " + path_);
  if (open()) return;
  bag_.reset();
  connections_.clear();
  const std::string end = scan_bag(
      path_, [this](const Connection& found) { connections_.push_back(found); }, {}, run_);
  damage_ += "; " + end;
}

Reader::~Reader() = default;

bool Reader::open() {
  try {
    bag_ = std::make_unique<rosbag::Bag>(path_, rosbag::bagmode::Read);
    rosbag::View view(*bag_);
    for (const auto* info : view.getConnections()) connections_.push_back(connection_of(*info));
    return true;
  } catch (const rosbag::BagUnindexedException&) {
    damage_ = "its recorder did not close it";
  } catch (const rosbag::BagException& error) {
    damage_ = std::string("its index cannot be read (") + error.what() + ")";
  }
  return false;
}

void Reader::read(const Filter& wanted, const Visitor& visit) {
  run_.begin("reading " + path_);
  if (!bag_) {
    scan_bag(
        path_, [](const Connection&) {},
        [&](const RawMessage& message) {
          if (wanted(message.connection)) visit(message);
        },
        run_);
    return;
  }
  try {
    read_indexed(wanted, visit);
  } catch (const rosbag::BagException& error) {
    throw BagError(std::string("the bag is damaged: ") + error.what());
  }
}

void Reader::read_indexed(const Filter& wanted, const Visitor& visit) {
  std::map<std::uint32_t, const Connection*> by_id;
  for (const auto& connection : connections_) by_id[connection.id] = &connection;
  rosbag::View view(*bag_, [&](const rosbag::ConnectionInfo* info) { return wanted(*by_id.at(info->id)); });
  // A message and its connection share one header.
  std::map<const ::ros::M_string*, const Connection*> by_header;
  for (const auto* info : view.getConnections()) by_header[info->header.get()] = by_id.at(info->id);
  const double total = view.size();
  double done = 0;
  std::vector<std::uint8_t> bytes;
  for (const auto& instance : view) {
    run_.at(done++ / total);
    bytes.resize(instance.size());
    ::ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    instance.write(stream);
    visit({*by_header.at(instance.getConnectionHeader().get()), bytes});
  }
}

}  // namespace trk_bridge::bag
