// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Draws a camera in the scene.
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "camera/figure.h"
#include "drawables.h"
#include "trail.h"

namespace trk_bridge::rviz_display {

/// Lengths and line widths in m, colours with alpha.
struct FigureStyle {
  struct Frustum {
    bool on = true;
    Ogre::ColourValue colour;
    double near = 0.2, far = 3;  ///< not drawn unless near < far
  } frustum;
  /// Outline opaque, area inside with the alpha of the colour.
  struct ImagePlane {
    bool on = true;
    Ogre::ColourValue colour;
    double distance = 1;
    bool undistorted = true;  ///< also the outline of the pinhole camera, dashed
  } image_plane;
  struct FocusPlane {
    bool on = true;
    Ogre::ColourValue colour;
  } focus_plane;
  struct OpticalAxis {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 4;
  } axis;
  struct Body {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 0.4;
  } body;
  struct Text {
    bool on = true;
    Ogre::ColourValue colour;
    double height = 0.2;
  } name, values;
  struct Trail {
    bool on = true;
    Ogre::ColourValue colour;
    double length = 5;  ///< seconds
    double line_width = 0.01;
  } trail;
  double line_width = 0.01;  ///< of all lines except the trail
};

/// For the rendering thread. Nothing is visible before place() and shape().
class CameraFigure {
 public:
  CameraFigure(Ogre::SceneManager* scene, Ogre::SceneNode* fixed);

  /// Sets the lines and areas that depend on the lens; without border (invalid lens) frustum and planes are not drawn.
  /// `focus_distance` in m.
  void shape(const camera::ImageBorder* border, double focus_distance, const FigureStyle& style);
  void place(const Eigen::Isometry3d& fixed_T_optical);
  void write(const std::string& name, const std::string& values, const FigureStyle& style);
  void draw(const Trail& trail, const FigureStyle& style);
  /// Shows or hides everything.
  void set_visible(bool visible);

 private:
  void shape_frustum(const camera::ImageBorder&, const FigureStyle&);
  void shape_image_plane(const camera::ImageBorder&, const FigureStyle&);
  void shape_focus_plane(const camera::ImageBorder&, double distance, const FigureStyle&);

  Ogre::SceneNode* fixed_;
  ScopedSceneNode root_, optical_;
  Lines frustum_, image_outline_, straight_outline_, focus_outline_, axis_, trail_;
  Area image_area_, focus_area_;
  Body body_;
  Label name_, values_;
};

}  // namespace trk_bridge::rviz_display
