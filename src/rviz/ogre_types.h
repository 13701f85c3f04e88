// Ogre's side of points, poses and scene nodes. Ogre counts in floats.
#pragma once

#include <memory>

#include <OgreColourValue.h>
#include <OgreQuaternion.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/ogre_vector.h>
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

}  // namespace trk_bridge::rviz_display
