// What every nodelet's onInit does.
#pragma once

#include <memory>

#include <nodelet/nodelet.h>

namespace trk_bridge::nodes {

/// Runs a `Node`, made from (node handle, private node handle, full name), from loading to unloading. A failed start is
/// a fatal message with the reason, and an exception, so that loading fails.
template <typename Node>
class RunningNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      running_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(getName() << " cannot start: " << error.what());
      throw;
    }
  }

  std::unique_ptr<Node> running_;
};

}  // namespace trk_bridge::nodes
