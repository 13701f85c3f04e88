// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "floor_relay.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <variant>

#include <sensor_msgs/CameraInfo.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2_msgs/TFMessage.h>
#include <boost/make_shared.hpp>

#include "trk_bridge/ros/messages.h"
#include "trk_bridge/wire/codec.h"

namespace trk_bridge::bench {
namespace {

constexpr double radians = 3.14159265358979323846 / 180;

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

}  // namespace

LoopbackSocket::LoopbackSocket(int port) : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const sockaddr_in address = loopback(port);
  if (fd_ < 0 || ::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("udp port " + std::to_string(port) + ": " + std::strerror(errno));
  }
}

LoopbackSocket::~LoopbackSocket() { ::close(fd_); }

int LoopbackSocket::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

void LoopbackSocket::send(const char* data, std::size_t size, int to_port) const {
  const sockaddr_in address = loopback(to_port);
  if (::sendto(fd_, data, size, 0, reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
    throw std::runtime_error("udp port " + std::to_string(to_port) + ": " + std::strerror(errno));
  }
}

std::size_t LoopbackSocket::receive(char* data, std::size_t size) const {
  const ssize_t received = ::recv(fd_, data, size, 0);
  return received < 0 ? 0 : static_cast<std::size_t>(received);
}

void LoopbackSocket::close() const { ::shutdown(fd_, SHUT_RDWR); }

FloorIn::FloorIn(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string&)
    : socket_(private_node.param("port", 0)),
      params_(node.advertise<trk_bridge::CameraParams>("params", 100)),
      camera_info_(node.advertise<sensor_msgs::CameraInfo>("camera_info", 100)),
      tf_(node.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      thread_([this] { run(); }) {}

FloorIn::~FloorIn() {
  socket_.close();
  thread_.join();
}

void FloorIn::run() {
  wire::Buffer buffer;
  wire::LayoutDetector detector;
  while (const std::size_t size = socket_.receive(buffer.data(), buffer.size())) {
    const auto stamp = ::ros::Time::now();
    const auto decoded = wire::decode({buffer.data(), size}, detector);
    const auto* record = decoded ? std::get_if<wire::CameraParams>(&decoded->record) : nullptr;
    if (record == nullptr) continue;

    const auto tf = boost::make_shared<tf2_msgs::TFMessage>();
    auto& transform = tf->transforms.emplace_back();
    transform.header.stamp = stamp;
    transform.header.frame_id = "studio";
    transform.child_frame_id = "camera";
    transform.transform.translation.x = record->euler.x;
    transform.transform.translation.y = record->euler.y;
    transform.transform.translation.z = record->euler.z;
    tf2::Quaternion turn;
    turn.setRPY(record->euler.tilt * radians, record->euler.roll * radians, record->euler.pan * radians);
    transform.transform.rotation.x = turn.x();
    transform.transform.rotation.y = turn.y();
    transform.transform.rotation.z = turn.z();
    transform.transform.rotation.w = turn.w();
    tf_.publish(tf);

    const auto params = boost::make_shared<trk_bridge::CameraParams>();
    params->header.stamp = stamp;
    params->header.frame_id = "studio";
    ros1::to_msg(*record, *params);
    params_.publish(params);

    const auto info = boost::make_shared<sensor_msgs::CameraInfo>();
    const double f = 960 / std::tan(record->fov * radians / 2);
    info->header.stamp = stamp;
    info->header.frame_id = "camera_optical";
    info->width = 1920;
    info->height = 1080;
    info->distortion_model = "plumb_bob";
    info->D.assign(5, 0);
    info->K = {f, 0, 960, 0, f, 540, 0, 0, 1};
    info->R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info->P = {f, 0, 960, 0, 0, f, 540, 0, 0, 0, 1, 0};
    camera_info_.publish(info);
  }
}

FloorOut::FloorOut(::ros::NodeHandle node, const ::ros::NodeHandle& private_node, const std::string&)
    : port_(private_node.param("port", 0)), socket_(0) {
  params_ = node.subscribe<trk_bridge::CameraParams>(
      "params", 100, [this](const trk_bridge::CameraParamsConstPtr& message) { receive(*message); },
      ::ros::VoidConstPtr(), ::ros::TransportHints().tcpNoDelay());
}

void FloorOut::receive(const trk_bridge::CameraParams& message) const {
  wire::Buffer buffer;
  const auto datagram = wire::encode(ros1::from_msg(message), {}, buffer);
  if (datagram) socket_.send(datagram->data(), datagram->size(), port_);
}

}  // namespace trk_bridge::bench
