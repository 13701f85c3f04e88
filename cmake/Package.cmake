# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# For find_package(trk_bridge CONFIG) in other projects.
install(EXPORT trk_bridge NAMESPACE trk_bridge:: FILE trk_bridgeTargets.cmake DESTINATION ${TRK_BRIDGE_CMAKE_DIR})

if(TRK_BRIDGE_ROS)
  # catkin makes trk_bridgeConfig.cmake; the devel space has targets, too.
  export(EXPORT trk_bridge NAMESPACE trk_bridge::
    FILE ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake/trk_bridgeTargets.cmake)
else()
  include(CMakePackageConfigHelpers)
  configure_file(cmake/trk_bridge-extras.cmake.in trk_bridgeConfig.cmake @ONLY)
  write_basic_package_version_file(trk_bridgeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  # Both are made above.
  #catkin_lint: ignore_once missing_file
  install(FILES ${PROJECT_BINARY_DIR}/trk_bridgeConfig.cmake ${PROJECT_BINARY_DIR}/trk_bridgeConfigVersion.cmake
    DESTINATION ${TRK_BRIDGE_CMAKE_DIR})
endif()

# Files for pkg-config: for the C libraries, and for the C++ libraries that other projects can link. Paths are relative
# to the .pc file, so that an installation can be moved. The trk_bridge.pc that catkin_package() would make has a fixed
# prefix and a wrong include path, and requires packages without .pc files on some systems (pluginlib).
file(RELATIVE_PATH TRK_PC_TO_PREFIX /prefix/${TRK_BRIDGE_LIB_DIR}/pkgconfig /prefix)
set(TRK_PC_LIBS)
foreach(library endpoints camera transport wire base)
  string(APPEND TRK_PC_LIBS " -ltrk_bridge_${library}")
endforeach()
set(TRK_PC_REQUIRES)
if(TRK_BRIDGE_ROS)
  string(PREPEND TRK_PC_LIBS "-ltrk_bridge_ros")
  # Packages whose headers our headers include.
  set(TRK_PC_REQUIRES " geometry_msgs roscpp sensor_msgs std_msgs")
endif()
string(STRIP "${TRK_PC_LIBS}" TRK_PC_LIBS)

# trk_bridge_pkg_config(NAME TEMPLATE)
function(trk_bridge_pkg_config TRK_PC_NAME template)
  if(TRK_BRIDGE_ROS)
    # For users who have sourced the devel space.
    set(TRK_PC_INCLUDE_DIR ${PROJECT_SOURCE_DIR}/include)
    set(TRK_PC_CFLAGS " -I\${prefix}/include")  # of generated messages
    configure_file(cmake/${template} ${CATKIN_DEVEL_PREFIX}/${TRK_BRIDGE_LIB_DIR}/pkgconfig/${TRK_PC_NAME}.pc @ONLY)
  endif()
  set(TRK_PC_CFLAGS)
  set(TRK_PC_INCLUDE_DIR "\${prefix}/${TRK_BRIDGE_INCLUDE_DIR}")
  configure_file(cmake/${template} pkgconfig/${TRK_PC_NAME}.pc @ONLY)
  # Made above.
  #catkin_lint: ignore_once missing_file
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${TRK_PC_NAME}.pc DESTINATION ${TRK_BRIDGE_LIB_DIR}/pkgconfig)
endfunction()
trk_bridge_pkg_config(trk trk.pc.in)
trk_bridge_pkg_config(trk_identified trk.pc.in)
if(NOT TRK_BRIDGE_LIBTRK_ONLY)
  trk_bridge_pkg_config(trk_bridge trk_bridge.pc.in)
endif()
