// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "camera_figure.h"

#include <vector>

namespace trk_bridge::rviz_display {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Ogre::ColourValue opaque(Ogre::ColourValue colour) {
  colour.a = 1;
  return colour;
}

/// A closed outline as pairs of points.
Points segments(const Points& outline) {
  Points pairs;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    pairs.push_back(outline[i - 1]);
    pairs.push_back(outline[i]);
  }
  return pairs;
}

/// Dashes that begin and end at the corners.
Points dashed(const camera::ImageBorder::Corners& corners, double depth) {
  constexpr int dashes = 12;
  Points pairs;
  for (std::size_t side = 0; side < corners.size(); ++side) {
    const Eigen::Vector3d from = depth * corners[side];
    const Eigen::Vector3d way = depth * corners[(side + 1) % corners.size()] - from;
    for (int i = 0; i < dashes; ++i) {
      pairs.push_back(from + way * (2 * i) / (2 * dashes - 1));
      pairs.push_back(from + way * (2 * i + 1) / (2 * dashes - 1));
    }
  }
  return pairs;
}

}  // namespace

CameraFigure::CameraFigure(Ogre::SceneManager* scene, Ogre::SceneNode* fixed)
    : fixed_(fixed),
      root_(make_node(fixed)),
      optical_(make_node(root_.get())),
      frustum_(scene, optical_.get()),
      image_outline_(scene, optical_.get()),
      straight_outline_(scene, optical_.get()),
      focus_outline_(scene, optical_.get()),
      axis_(scene, optical_.get()),
      trail_(scene, root_.get()),
      image_area_(scene, optical_.get()),
      focus_area_(scene, optical_.get()),
      body_(scene, optical_.get()),
      name_(optical_.get(), Label::Side::above),
      values_(optical_.get(), Label::Side::below) {
  set_visible(false);
}

void CameraFigure::shape(const camera::ImageBorder* border, double focus_distance, const FigureStyle& style) {
  frustum_.hide();
  image_outline_.hide();
  straight_outline_.hide();
  image_area_.hide();
  focus_outline_.hide();
  focus_area_.hide();
  if (border != nullptr) {
    if (style.frustum.on && style.frustum.near < style.frustum.far) shape_frustum(*border, style);
    if (style.image_plane.on) shape_image_plane(*border, style);
    if (style.focus_plane.on && camera::draws_focus(focus_distance)) shape_focus_plane(*border, focus_distance, style);
  }

  const Points axis{Eigen::Vector3d::Zero(), style.axis.length * Eigen::Vector3d::UnitZ()};
  axis_.show(style.axis.on ? axis : Points{}, style.axis.colour, static_cast<float>(style.line_width));
  if (style.body.on) {
    body_.show(style.body.colour, static_cast<float>(style.body.length));
  } else {
    body_.hide();
  }
}

void CameraFigure::shape_frustum(const camera::ImageBorder& border, const FigureStyle& style) {
  frustum_.show(camera::frustum_lines(border, style.frustum.near, style.frustum.far), style.frustum.colour,
                static_cast<float>(style.line_width));
}

void CameraFigure::shape_image_plane(const camera::ImageBorder& border, const FigureStyle& style) {
  const auto& plane = style.image_plane;
  image_outline_.show(segments(camera::outline_at(border, plane.distance)), opaque(plane.colour),
                      static_cast<float>(style.line_width));
  image_area_.show(camera::area_at(border, plane.distance), plane.colour);
  if (plane.undistorted) {
    straight_outline_.show(dashed(border.straight, plane.distance), opaque(plane.colour),
                           static_cast<float>(style.line_width / 2));
  }
}

void CameraFigure::shape_focus_plane(const camera::ImageBorder& border, double distance, const FigureStyle& style) {
  focus_outline_.show(segments(camera::outline_at(border, distance)), opaque(style.focus_plane.colour),
                      static_cast<float>(style.line_width));
  focus_area_.show(camera::area_at(border, distance), style.focus_plane.colour);
}

void CameraFigure::place(const Eigen::Isometry3d& fixed_T_optical) {
  optical_->setPosition(to_ogre(Eigen::Vector3d(fixed_T_optical.translation())));
  optical_->setOrientation(to_ogre(Eigen::Quaterniond(fixed_T_optical.linear())));
}

void CameraFigure::write(const std::string& name, const std::string& values, const FigureStyle& style) {
  // Outside the body in any orientation.
  const double distance = style.body.on ? 0.45 * style.body.length : 0.02;
  const auto write_one = [distance](Label& label, const std::string& text, const FigureStyle::Text& as) {
    label.show(as.on ? text : "", as.colour, static_cast<float>(as.height), static_cast<float>(distance));
  };
  write_one(name_, name, style.name);
  write_one(values_, values, style.values);
}

void CameraFigure::draw(const Trail& trail, const FigureStyle& style) {
  for (Lines* lines : {&frustum_, &image_outline_, &straight_outline_, &focus_outline_, &axis_}) lines->face_viewer();
  trail_.show(style.trail.on ? lines_of(trail) : Points{}, style.trail.colour,
              static_cast<float>(style.trail.line_width));
}

void CameraFigure::set_visible(bool visible) {
  const bool is_visible = root_->getParentSceneNode() != nullptr;
  if (visible == is_visible) return;
  if (visible) {
    fixed_->addChild(root_.get());
  } else {
    fixed_->removeChild(root_.get());
  }
}

}  // namespace trk_bridge::rviz_display
