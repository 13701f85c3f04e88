// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Saved configurations are loaded again.
#include <map>
#include <stdexcept>
#include <string>

#include "camera_display.h"
#include "published_camera.h"
#include "temporary_directory.h"

namespace trk_bridge::test::configuration_test {

using Values = std::map<std::string, std::string>;

/// All that is saved below a property, by path.
void collect(const rviz::Property& root, const std::string& path, Values& values) {
  for (int i = 0; i < root.numChildren(); ++i) {
    const auto& child = *root.childAt(i);
    if (!child.shouldBeSaved()) continue;
    const std::string name = path + "/" + child.getNameStd();
    values[name] = child.getValue().toString().toStdString();
    collect(child, name, values);
  }
}

Values values_of(const rviz::Display& display) {
  Values values;
  collect(display, "", values);
  return values;
}

/// Changes every value to another one of its kind.
void change_everything(rviz::Property& root) {
  for (int i = 0; i < root.numChildren(); ++i) {
    auto& child = *root.childAt(i);
    if (!child.shouldBeSaved()) continue;
    const QVariant value = child.getValue();
    const std::string name = child.getNameStd();
    if (name == "Color") {
      child.setValue(QColor(12, 34, 56 + i));
    } else if (name == "Alpha") {
      child.setValue(0.375);
    } else if (name.find("Topic") != std::string::npos) {
      child.setValue(value.toString() + "/changed");
    } else if (value.type() == QVariant::Bool) {
      child.setValue(!value.toBool());
    } else if (value.type() == QVariant::Double || value.type() == int(QMetaType::Float)) {
      child.setValue(value.toDouble() + 0.125);
    } else if (value.type() == QVariant::Int) {
      child.setValue(value.toInt() + 1);
    } else if (value.type() == QVariant::String) {
      child.setValue(value.toString() + " changed");
    }
    change_everything(child);
  }
}

/// The displays of a saved configuration, without the window's sizes of panels.
std::string displays_of(const std::string& path) {
  const std::string text = read_text(path);
  const auto begin = text.find("Visualization Manager:"), end = text.find("Window Geometry:");
  if (begin >= end || end == std::string::npos) throw std::runtime_error(path + " is no configuration");
  return text.substr(begin, end - begin);
}

class Configuration : public ::testing::Test {
 protected:
  void SetUp() override { window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION); }
  void TearDown() override { window().remove_all(); }

  const TemporaryDirectory directory;
};

TEST_F(Configuration, EveryPropertyIsSavedAndLoadedAgain) {
  auto& display = window().add("trk_bridge/Camera", "Changed");
  property(display, {"Camera Info Topic"}).setValue("/one/camera_info");
  property(display, {"Camera Params Topic"}).setValue("/one/params");
  const auto before = values_of(display);
  change_everything(display);
  const auto changed = values_of(display);
  for (const auto& [path, value] : before) {
    EXPECT_TRUE(value.empty() || changed.at(path) != value) << path << " has not been changed";
  }
  window().save(directory / "saved.rviz");
  window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION);
  window().load(directory / "saved.rviz");
  EXPECT_EQ(values_of(window().display("Changed")), changed);
  window().save(directory / "again.rviz");
  EXPECT_EQ(displays_of(directory / "again.rviz"), displays_of(directory / "saved.rviz"));
}

TEST_F(Configuration, ALoadedDisplayDraws) {
  const auto tracked = plain_camera();
  const PublishedCamera camera("configured", tracked);
  window().look({{0, 1.5, 1}, 10, -1.2, 0.4});
  add_frustum("Camera", camera.info_topic(), camera.params_topic());
  ASSERT_TRUE(becomes(tracked));
  window().save(directory / "saved.rviz");
  window().load(TRK_BRIDGE_RVIZ_TEST_CONFIGURATION);
  EXPECT_TRUE(vanishes());
  window().load(directory / "saved.rviz");
  EXPECT_TRUE(becomes(tracked)) << statuses(window().display("Camera"));
}

}  // namespace trk_bridge::test::configuration_test
