// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// The program rviz in the test's process: its window on the X screen, its displays as a user sees them.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <rviz/display.h>
#include <rviz/properties/status_property.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <rviz/visualizer_app.h>
#include <QApplication>
#include <QRect>
#include <QVariant>

#include "deadline.h"
#include "picture.h"
#include "view.h"

namespace trk_bridge::test {

/// Below a property (a display, a view) by the names of the tree's entries. Throws std::out_of_range for one that is
/// not there.
rviz::Property& property(rviz::Property& root, const std::vector<std::string>& names);

/// The colour of such an entry. Throws std::out_of_range, or std::bad_cast if it is not a colour.
QColor colour_of(rviz::Property& root, const std::vector<std::string>& names);

struct Status {
  rviz::StatusProperty::Level level;
  std::string text;
};

/// The text under `name` in the display's status list; none if there is no such line.
std::optional<Status> status(const rviz::Display& display, const std::string& name);

/// All lines, for messages.
std::string statuses(const rviz::Display& display);

class RvizWindow {
 public:
  /// Starts rviz like its program, with a configuration. `application` outlives it. Throws std::runtime_error.
  RvizWindow(QApplication& application, const std::string& configuration);

  /// Handles pending work of the window and ROS until `condition` is met or the deadline has passed; whether it was
  /// met.
  bool eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within = deadline);

  /// Handles pending work until rviz has drawn `frames` whole new frames.
  ::testing::AssertionResult draws(int frames = 2);

  void load(const std::string& path);
  void save(const std::string& path);

  /// Like the dialogue. Throws std::runtime_error if the class cannot be loaded.
  rviz::Display& add(const std::string& class_id, const std::string& name);
  void remove(rviz::Display& display);
  void remove_all();
  /// Throws std::out_of_range.
  rviz::Display& display(const std::string& name);

  rviz::VisualizationManager& manager() { return *frame_->getManager(); }

  void look(const OrbitView::Place& place);
  /// From the view's properties, not from the renderer.
  OrbitView view();
  /// The place of the point by Ogre's camera, in pixels of the 3D view.
  Eigen::Vector2d rendered_at(const Eigen::Vector3d& point);

  /// The 3D view as it is on the screen after the next frames.
  Picture picture();
  /// The whole screen as it is.
  static QImage screen();

  /// Waits until this line of the display's status has the level and contains `text`.
  ::testing::AssertionResult shows_status(const rviz::Display& display, const std::string& name,
                                          rviz::StatusProperty::Level level, const std::string& text = "");

 private:
  QWidget& panel();

  QApplication* application_;
  std::unique_ptr<rviz::VisualizerApp> program_;
  rviz::VisualizationFrame* frame_ = nullptr;
};

/// The window of this process, created by main().
RvizWindow& window();

/// A directory for pictures: where the results of the tests are written.
std::string results_directory();

}  // namespace trk_bridge::test
