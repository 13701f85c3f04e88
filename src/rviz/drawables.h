// What a camera is drawn with: Ogre's side of points and poses, and areas, lines, a body and words in a scene. Ogre
// counts in floats.
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

/// A scene node that is taken out of the scene with its owner. What is attached to it must go first.
struct SceneNodeDeleter {
  void operator()(Ogre::SceneNode* node) const { node->getCreator()->destroySceneNode(node); }
};
using ScopedSceneNode = std::unique_ptr<Ogre::SceneNode, SceneNodeDeleter>;

inline ScopedSceneNode make_node(Ogre::SceneNode* parent) { return ScopedSceneNode(parent->createChildSceneNode()); }

/// A filled area in one colour, unlit, seen from both sides.
class Area {
 public:
  Area(Ogre::SceneManager* scene, Ogre::SceneNode* parent);
  ~Area();
  Area(const Area&) = delete;
  Area& operator=(const Area&) = delete;

  /// Three points a triangle, in the parent's frame. None shows nothing.
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

  /// Pairs of points, a segment each, in the parent's frame; `width` in m. None shows nothing.
  void show(const std::vector<Eigen::Vector3d>& pairs, const Ogre::ColourValue& colour, float width);
  void hide() { line_.clear(); }

  /// To be called before every frame: makes the lines as wide as they are for whoever looks at them from anywhere.
  void face_viewer();

 private:
  rviz::BillboardLine line_;
  float width_ = 0;
  std::uint32_t room_ = 0;  // for so many segments
};

/// A camera's body: a box behind the optical centre, the lens before it, a handle on top that shows which way is up.
class Body {
 public:
  /// `optical` is a node in the optical frame: the lens ends in its origin.
  Body(Ogre::SceneManager* scene, Ogre::SceneNode* optical);

  /// `length` in m, from the lens to the end of the box.
  void show(const Ogre::ColourValue& colour, float length);
  void hide();

 private:
  ScopedSceneNode node_;
  Ogre::SceneNode* optical_;
  std::array<std::unique_ptr<rviz::Shape>, 4> shapes_;
};

/// Words in the scene that face the viewer.
class Label {
 public:
  enum class Side { above, below };
  /// Stands above or below the node's origin, on top of whatever is in front of it.
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
