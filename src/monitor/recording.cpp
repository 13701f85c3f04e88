// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "recording.h"

#include <mutex>
#include <variant>

#include "cli/arguments.h"

namespace trk_bridge::monitor {

namespace {

constexpr const char* url = "file:take-%Y%m%d-%H%M%S.trk";

}  // namespace

/// The cause of the first loss. Any thread.
struct Recording::FirstLoss {
  void note(const bridge::Loss& loss) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (text.empty()) text = std::visit([](const auto& cause) { return describe(cause); }, loss.cause);
  }
  std::string first() {
    const std::lock_guard<std::mutex> lock(mutex);
    return text;
  }

 private:
  std::mutex mutex;
  std::string text;
};

std::string Recording::begin(const CameraState& camera) {
  const std::string who = "id " + std::to_string(camera.key.id);
  if (!camera.latest) return "not recorded: no parameters of " + who + " received yet";
  if (!camera.latest->lens && camera.latest->lens.error() == camera::CameraReason::no_lens) {
    return "not recorded: " + who + " has no lens, but a take needs one";
  }
  if (!camera.constants) return "not recorded: no constants of " + who + " received yet, and a take begins with them";
  key_ = camera.key;
  first_loss_ = std::make_shared<FirstLoss>();
  bridge::OutletOptions options;
  options.feed = bridge::Feed::one_camera;
  options.listener = [first = first_loss_](const bridge::Loss& loss) { first->note(loss); };
  outlet_ = std::make_unique<bridge::Outlet>(cli::sink_from(url), options);
  auto constants = *camera.constants;
  constants.id = key_.id;
  outlet_->write(constants);
  return "recording " + who;
}

void Recording::add(const transport::Sample& sample) {
  if (!outlet_ || !(sample.sender == key_.sender)) return;
  if (const auto* params = std::get_if<wire::CameraParams>(&sample.record)) {
    if (params->id == key_.id && sample.has_lens) outlet_->write(*params, {sample.arrival, sample.time_code});
  } else if (const auto* constants = std::get_if<wire::CameraConstants>(&sample.record)) {
    if (constants->id == key_.id) outlet_->write(*constants);
  }
}

std::string Recording::status() const {
  if (!outlet_) return {};
  const auto state = outlet_->state();
  std::string text = "recording " + state.name + ", " + std::to_string(outlet_->statistics().sent.params) + " records";
  if (!state.cannot_open.empty()) text += ": " + state.cannot_open;
  if (const auto loss = first_loss_->first(); !loss.empty()) text += ": " + loss;
  return text;
}

std::string Recording::end() {
  if (!outlet_) return {};
  const auto closed = outlet_->close();
  const std::string name = outlet_->state().name;
  const auto params = outlet_->statistics().sent.params;
  const auto loss = first_loss_->first();
  outlet_.reset();
  if (!closed) return "not recorded: " + name + ": " + transport::describe(closed.error());
  return "recorded " + name + ", " + std::to_string(params) + " records" + (loss.empty() ? "" : ": " + loss);
}

}  // namespace trk_bridge::monitor
