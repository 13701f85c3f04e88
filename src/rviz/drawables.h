// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// Objects in a scene of Ogre: areas, lines, a body and text; and conversions of points and poses to Ogre, which uses
// float.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <OgreColourValue.h>
#include <OgreManualObject.h>
#include <OgreMaterial.h>
#include <OgreQuaternion.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/billboard_line.h>
#include <rviz/ogre_helpers/movable_text.h>
#include <rviz/ogre_helpers/ogre_vector.h>
#include <rviz/ogre_helpers/shape.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trk_bridge::rviz_display {

inline Ogre::Vector3 to_ogre(const Eigen::Vector3d& point) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())};
}

inline Ogre::Quaternion to_ogre(const Eigen::Quaterniond& rotation) {
  return {static_cast<float>(rotation.w()), static_cast<float>(rotation.x()), static_cast<float>(rotation.y()),
          static_cast<float>(rotation.z())};
}

/// A scene node that is removed from the scene with its owner. Objects attached to it must be destroyed first.
struct SceneNodeDeleter {
  void operator()(Ogre::SceneNode* node) const { node->getCreator()->destroySceneNode(node); }
};
using ScopedSceneNode = std::unique_ptr<Ogre::SceneNode, SceneNodeDeleter>;

inline ScopedSceneNode make_node(Ogre::SceneNode* parent) { return ScopedSceneNode(parent->createChildSceneNode()); }

/// A filled area in one colour, unlit, visible from both sides.
class Area {
 public:
  Area(Ogre::SceneManager* scene, Ogre::SceneNode* parent);
  ~Area();
  Area(const Area&) = delete;
  Area& operator=(const Area&) = delete;

  /// Three points per triangle, in the frame of the parent. No points: nothing is shown.
  void show(const std::vector<Eigen::Vector3d>& triangles, const Ogre::ColourValue& colour);
  void hide() { object_->clear(); }

 private:
  Ogre::SceneManager* scene_;
  Ogre::MaterialPtr material_;
  Ogre::ManualObject* object_;
};

/// Line segments in one colour, unlit.
class Lines {
 public:
  Lines(Ogre::SceneManager* scene, Ogre::SceneNode* parent);

  /// Pairs of points, one per segment, in the frame of the parent; `width` in m. No points: nothing is shown.
  void show(const std::vector<Eigen::Vector3d>& pairs, const Ogre::ColourValue& colour, float width);
  void hide() { line_.clear(); }

  /// Call before every frame: turns the lines to the viewer, so that their width is right.
  void face_viewer();

 private:
  rviz::BillboardLine line_;
  float width_ = 0;
  std::uint32_t room_ = 0;  // capacity in segments
};

/// The body of a camera: a lens that ends in the optical centre, a box behind it, and a handle on top that shows the up
/// direction.
class Body {
 public:
  /// `optical` is a node in the optical frame: the lens ends at its origin.
  Body(Ogre::SceneManager* scene, Ogre::SceneNode* optical);

  /// `length` in m, from the lens to the end of the box.
  void show(const Ogre::ColourValue& colour, float length);
  void hide();

 private:
  ScopedSceneNode node_;
  Ogre::SceneNode* optical_;
  std::array<std::unique_ptr<rviz::Shape>, 4> shapes_;
};

/// Text in the scene that faces the viewer.
class Label {
 public:
  enum class Side { above, below };
  /// Above or below the origin of the node; drawn over objects in front of it.
  Label(Ogre::SceneNode* parent, Side side);

  /// UTF-8; `height` of a capital letter and `distance` from the origin, up or down in the fixed frame, in m.
  void show(const std::string& text, const Ogre::ColourValue& colour, float height, float distance);
  void hide() { text_.setVisible(false); }

 private:
  ScopedSceneNode node_;
  Side side_;
  rviz::MovableText text_;
};

}  // namespace trk_bridge::rviz_display
