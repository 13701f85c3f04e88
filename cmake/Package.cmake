# find_package(trk_bridge CONFIG) of other projects.
install(EXPORT trk_bridge NAMESPACE trk_bridge:: FILE trk_bridgeTargets.cmake DESTINATION ${TRK_BRIDGE_CMAKE_DIR})

if(TRK_BRIDGE_ROS)
  # trk_bridgeConfig.cmake is catkin's; the devel space has targets, too.
  export(EXPORT trk_bridge NAMESPACE trk_bridge::
    FILE ${CATKIN_DEVEL_PREFIX}/${TRK_BRIDGE_CMAKE_DIR}/trk_bridgeTargets.cmake)
else()
  include(CMakePackageConfigHelpers)
  configure_file(cmake/trk_bridge-extras.cmake.in trk_bridgeConfig.cmake @ONLY)
  write_basic_package_version_file(trk_bridgeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  # Both are made above.
  #catkin_lint: ignore_once missing_file
  install(FILES ${PROJECT_BINARY_DIR}/trk_bridgeConfig.cmake ${PROJECT_BINARY_DIR}/trk_bridgeConfigVersion.cmake
    DESTINATION ${TRK_BRIDGE_CMAKE_DIR})
endif()
