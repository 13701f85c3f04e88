// A camera in the scene.
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "area.h"
#include "body.h"
#include "figure_style.h"
#include "label.h"
#include "lines.h"
#include "ogre_types.h"
#include "trail.h"
#include "camera/figure.h"

namespace trk_bridge::rviz_display {

/// For the thread that renders. Nothing is seen of it before place() and shape().
class CameraFigure {
 public:
  CameraFigure(Ogre::SceneManager* scene, Ogre::SceneNode* fixed);

  /// The lines and areas that follow from the lens; with no border (the lens is none) the frustum and the planes are
  /// left out. `focus_distance` in m.
  void shape(const camera::ImageBorder* border, double focus_distance, const FigureStyle& style);
  void place(const Eigen::Isometry3d& fixed_T_optical);
  void write(const std::string& name, const std::string& values, const FigureStyle& style);
  void draw(const Trail& trail, const FigureStyle& style);
  /// All of it or nothing.
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
