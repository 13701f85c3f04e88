// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "window.h"

#include <algorithm>
#include <cmath>

#include <OgreCamera.h>
#include <rviz/display_factory.h>
#include <rviz/display_group.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/status_list.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <QGuiApplication>
#include <QScreen>

namespace trk_bridge::test {
namespace {

RvizWindow* the_window = nullptr;

rviz::VisualizationFrame* frame_of(const QApplication&) {
  for (QWidget* widget : QApplication::topLevelWidgets()) {
    if (auto* frame = qobject_cast<rviz::VisualizationFrame*>(widget)) return frame;
  }
  throw std::runtime_error("rviz has made no window");
}

const rviz::StatusList* status_list(const rviz::Display& display) {
  for (int i = 0; i < display.numChildren(); ++i) {
    if (const auto* list = qobject_cast<const rviz::StatusList*>(display.childAt(i))) return list;
  }
  return nullptr;
}

}  // namespace

rviz::Property& property(rviz::Property& root, const std::vector<std::string>& names) {
  rviz::Property* at = &root;
  for (const auto& name : names) {
    rviz::Property* below = nullptr;
    for (int i = 0; i < at->numChildren() && below == nullptr; ++i) {
      if (at->childAt(i)->getNameStd() == name) below = at->childAt(i);
    }
    if (below == nullptr) throw std::out_of_range(at->getNameStd() + " has no property '" + name + "'");
    at = below;
  }
  return *at;
}

QColor colour_of(rviz::Property& root, const std::vector<std::string>& names) {
  return dynamic_cast<rviz::ColorProperty&>(property(root, names)).getColor();
}

std::optional<Status> status(const rviz::Display& display, const std::string& name) {
  const auto* list = status_list(display);
  for (int i = 0; list != nullptr && i < list->numChildren(); ++i) {
    const auto* line = qobject_cast<const rviz::StatusProperty*>(list->childAt(i));
    if (line != nullptr && line->getNameStd() == name) {
      return Status{line->getLevel(), line->getValue().toString().toStdString()};
    }
  }
  return std::nullopt;
}

std::string statuses(const rviz::Display& display) {
  std::string all;
  const auto* list = status_list(display);
  for (int i = 0; list != nullptr && i < list->numChildren(); ++i) {
    const auto* line = qobject_cast<const rviz::StatusProperty*>(list->childAt(i));
    all += "\n  " + line->getNameStd() + ": " + rviz::StatusProperty::statusWord(line->getLevel()).toStdString() +
           ": " + line->getValue().toString().toStdString();
  }
  return all;
}

RvizWindow::RvizWindow(QApplication& application, const std::string& configuration)
    : application_(&application), program_(std::make_unique<rviz::VisualizerApp>()) {
  program_->setApp(&application);
  // Smoothed edges have no single colour.
  std::vector<std::string> words{"rviz", "--disable-anti-aliasing", "--splash-screen", "", "-d", configuration};
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  if (!program_->init(static_cast<int>(arguments.size()), arguments.data())) {
    throw std::runtime_error("rviz does not start");
  }
  frame_ = frame_of(application);
  the_window = this;
}

RvizWindow& window() { return *the_window; }

bool RvizWindow::eventually(const std::function<bool()>& condition, std::chrono::nanoseconds within) {
  const auto end = std::chrono::steady_clock::now() + within;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    // rviz's timers ensure that there is always a next event.
    application_->processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
  return true;
}

::testing::AssertionResult RvizWindow::draws(int frames) {
  const auto wanted = manager().getFrameCount() + static_cast<std::uint64_t>(frames);
  if (eventually([this, wanted] { return manager().getFrameCount() >= wanted; })) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "rviz draws nothing any more";
}

void RvizWindow::load(const std::string& path) {
  if (!frame_->loadDisplayConfigHelper(path, /*discard_changes=*/true)) {
    throw std::runtime_error("rviz does not load " + path);
  }
}

void RvizWindow::save(const std::string& path) {
  if (!frame_->saveDisplayConfig(QString::fromStdString(path))) {
    throw std::runtime_error(frame_->getErrorMessage().toStdString());
  }
}

rviz::Display& RvizWindow::add(const std::string& class_id, const std::string& name) {
  const QString id = QString::fromStdString(class_id);
  if (!manager().getDisplayFactory()->getDeclaredClassIds().contains(id)) {
    throw std::runtime_error("rviz knows no display " + class_id);
  }
  return *manager().createDisplay(id, QString::fromStdString(name), /*enabled=*/true);
}

void RvizWindow::remove(rviz::Display& display) { delete &display; }

void RvizWindow::remove_all() { manager().removeAllDisplays(); }

rviz::Display& RvizWindow::display(const std::string& name) {
  auto& group = *manager().getRootDisplayGroup();
  for (int i = 0; i < group.numDisplays(); ++i) {
    if (group.getDisplayAt(i)->getNameStd() == name) return *group.getDisplayAt(i);
  }
  throw std::out_of_range("rviz has no display '" + name + "'");
}

void RvizWindow::look(const OrbitView::Place& place) {
  auto& view = *manager().getViewManager()->getCurrent();
  property(view, {"Focal Point", "X"}).setValue(place.focal_point.x());
  property(view, {"Focal Point", "Y"}).setValue(place.focal_point.y());
  property(view, {"Focal Point", "Z"}).setValue(place.focal_point.z());
  property(view, {"Distance"}).setValue(place.distance);
  property(view, {"Yaw"}).setValue(place.yaw);
  property(view, {"Pitch"}).setValue(place.pitch);
  property(view, {"Field of View"}).setValue(place.field_of_view);
}

OrbitView RvizWindow::view() {
  auto& view = *manager().getViewManager()->getCurrent();
  const auto number = [&view](const std::vector<std::string>& names) {
    return property(view, names).getValue().toDouble();
  };
  const OrbitView::Place place{
      {number({"Focal Point", "X"}), number({"Focal Point", "Y"}), number({"Focal Point", "Z"})},
      number({"Distance"}),
      number({"Yaw"}),
      number({"Pitch"}),
      number({"Field of View"})};
  return {place, {panel().width(), panel().height()}};
}

Eigen::Vector2d RvizWindow::rendered_at(const Eigen::Vector3d& point) {
  const Ogre::Camera& camera = *manager().getViewManager()->getCurrent()->getCamera();
  const Ogre::Vector3 seen =
      camera.getProjectionMatrix() *
      (camera.getViewMatrix() * Ogre::Vector3(Ogre::Real(point.x()), Ogre::Real(point.y()), Ogre::Real(point.z())));
  return {(1 + double{seen.x}) / 2 * panel().width(), (1 - double{seen.y}) / 2 * panel().height()};
}

QWidget& RvizWindow::panel() { return *manager().getRenderPanel(); }

Picture RvizWindow::picture() {
  EXPECT_TRUE(draws());
  const QPoint corner = panel().mapToGlobal(QPoint(0, 0));
  return Picture(screen().copy(corner.x(), corner.y(), panel().width(), panel().height()));
}

QImage RvizWindow::screen() { return QGuiApplication::primaryScreen()->grabWindow(0).toImage(); }

::testing::AssertionResult RvizWindow::shows_status(const rviz::Display& display, const std::string& name,
                                                    rviz::StatusProperty::Level level, const std::string& text) {
  const auto met = [&] {
    const auto line = status(display, name);
    return line && line->level == level && line->text.find(text) != std::string::npos;
  };
  if (eventually(met)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << name << " is not " << rviz::StatusProperty::statusWord(level).toStdString()
                                       << " '" << text << "', but:" << statuses(display);
}

}  // namespace trk_bridge::test
