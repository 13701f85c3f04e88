# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Messages and the catkin side of the package.
find_package(catkin REQUIRED COMPONENTS
  diagnostic_msgs
  diagnostic_updater
  geometry_msgs
  message_generation
  nodelet
  pluginlib
  roscpp
  sensor_msgs
  std_msgs
  std_srvs
  tf2_ros
  visualization_msgs
  xmlrpcpp
)
# Only for trk bag; nodes do not use it.
find_package(rosbag_storage REQUIRED)
find_package(roslz4 REQUIRED)
find_package(tf2 REQUIRED)
find_package(tf2_msgs REQUIRED)
find_package(BZip2 REQUIRED)
# To measure delays in pictures: delay_meter, trk delay.
find_package(cv_bridge REQUIRED)
# For test_card and tests.
find_package(image_geometry REQUIRED)
find_package(image_transport REQUIRED)
# For the display: rviz, and the Qt version that it uses.
find_package(rviz REQUIRED)
find_package(Qt5 ${rviz_QT_VERSION} REQUIRED COMPONENTS Core Gui Widgets)

add_message_files(DIRECTORY msg FILES CameraConstants.msg CameraParams.msg LensEncoders.msg TimeCode.msg)
add_service_files(DIRECTORY srv FILES SetSeconds.srv)
generate_messages(DEPENDENCIES std_msgs)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES trk trk_bridge_base trk_bridge_bridge trk_bridge_camera trk_bridge_endpoints trk_bridge_ros
    trk_bridge_transport trk_bridge_wire
  CATKIN_DEPENDS
    diagnostic_msgs
    diagnostic_updater
    geometry_msgs
    message_runtime
    nodelet
    pluginlib
    roscpp
    sensor_msgs
    std_msgs
    std_srvs
    tf2_ros
    visualization_msgs
    xmlrpcpp
  DEPENDS EIGEN3
  CFG_EXTRAS trk_bridge-extras.cmake
  # Package.cmake makes a better one, of the same name.
  SKIP_PKG_CONFIG_GENERATION
)

set(TRK_BRIDGE_LIB_DIR ${CATKIN_PACKAGE_LIB_DESTINATION})
set(TRK_BRIDGE_BIN_DIR ${CATKIN_GLOBAL_BIN_DESTINATION})
# Where rosrun searches; catkin_package() puts the programs of the devel space there, too.
set(TRK_BRIDGE_TOOL_DIR ${CATKIN_PACKAGE_BIN_DESTINATION})
# rosrun ignores a folder build/ in a package, so programs built there are found through a link.
string(FIND "${CATKIN_DEVEL_PREFIX}/" "${PROJECT_SOURCE_DIR}/build/" in_own_build_folder)
if(in_own_build_folder EQUAL 0)
  file(MAKE_DIRECTORY "${CATKIN_DEVEL_PREFIX}/${TRK_BRIDGE_TOOL_DIR}")
  file(CREATE_LINK "${CATKIN_DEVEL_PREFIX}/${TRK_BRIDGE_TOOL_DIR}" "${PROJECT_SOURCE_DIR}/.rosrun"
    RESULT linked SYMBOLIC)
  if(NOT linked EQUAL 0)
    message(WARNING "rosrun will not find the programs of this build: ${PROJECT_SOURCE_DIR}/.rosrun: ${linked}")
  endif()
endif()
set(TRK_BRIDGE_INCLUDE_DIR ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
set(TRK_BRIDGE_SHARE_DIR ${CATKIN_PACKAGE_SHARE_DESTINATION})
# The folder of the files of catkin_package(). Debian's catkin with prefix /usr puts them below the libraries.
set(TRK_BRIDGE_CMAKE_DIR ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
if(NOT CATKIN_GLOBAL_LIB_DESTINATION STREQUAL "lib")
  set(TRK_BRIDGE_CMAKE_DIR ${CATKIN_GLOBAL_LIB_DESTINATION}/cmake/${PROJECT_NAME})
endif()

install(DIRECTORY include/trk_bridge/ros DESTINATION ${TRK_BRIDGE_INCLUDE_DIR}/trk_bridge FILES_MATCHING PATTERN "*.h")
# The two files that are installed without ROS, too, are excluded.
install(DIRECTORY config launch urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}
  PATTERN presets.yaml EXCLUDE PATTERN lens_example.yaml EXCLUDE)
install(FILES nodelets.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
