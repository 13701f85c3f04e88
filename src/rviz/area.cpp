#include "area.h"

#include <string>

#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>

namespace trk_bridge::rviz_display {
namespace {

Ogre::MaterialPtr make_material() {
  static unsigned count = 0;  // scenes are for one thread
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "trk_bridge area " + std::to_string(count++), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->setLightingEnabled(false);
  material->setCullingMode(Ogre::CULL_NONE);
  material->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  material->setDepthWriteEnabled(false);
  return material;
}

}  // namespace

Area::Area(Ogre::SceneManager* scene, Ogre::SceneNode* parent)
    : scene_(scene), material_(make_material()), object_(scene->createManualObject()) {
  object_->setDynamic(true);
  parent->attachObject(object_);
}

Area::~Area() {
  scene_->destroyManualObject(object_);
  Ogre::MaterialManager::getSingleton().remove(material_->getHandle());
}

void Area::show(const std::vector<Eigen::Vector3d>& triangles, const Ogre::ColourValue& colour) {
  object_->clear();
  if (triangles.size() < 3) return;
  object_->estimateVertexCount(triangles.size());
  object_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, material_->getGroup());
  for (const auto& point : triangles) {
    object_->position(to_ogre(point));
    object_->colour(colour);
  }
  object_->end();
}

}  // namespace trk_bridge::rviz_display
