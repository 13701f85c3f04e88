# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Functions and options for all targets of this project.
include(CheckCXXSourceCompiles)

# std::from_chars for double reads numbers that the fast path does not handle.
set(CMAKE_REQUIRED_FLAGS -std=c++17)
check_cxx_source_compiles(
  "#include <charconv>
   int main() { double d = 0; return std::from_chars(\"1\", \"1\" + 1, d).ec == std::errc{} ? 0 : 1; }"
  TRK_BRIDGE_HAS_FROM_CHARS)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT TRK_BRIDGE_HAS_FROM_CHARS)
  message(FATAL_ERROR "trk_bridge needs std::from_chars for double: libstdc++ 11 or later (GCC 11); "
    "this compiler is ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}. Name a newer one with CXX=g++-11.")
endif()

add_library(trk_bridge_options INTERFACE)
# Functions of a library are never replaced by others with the same name, so calls within a library need no indirection.
target_compile_options(trk_bridge_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -fno-semantic-interposition
  $<$<BOOL:${TRK_BRIDGE_WERROR}>:-Werror>)

# trk_bridge_library(TARGET SOURCE... [PLUGIN] [EXPORT_AS NAME] [PUBLIC LIB...] [PRIVATE LIB...]): the library of a
# module, shared and installed; for tests in an emulator, static and not installed. With EXPORT_AS it is the target trk_bridge::NAME, for other projects as well. The binary
# interface is stable within a minor version; a PLUGIN, which ROS loads by its file name, has no version.
function(trk_bridge_library name)
  cmake_parse_arguments(ARG "PLUGIN" "EXPORT_AS" "PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} ${TRK_BRIDGE_LIBRARY_TYPE} ${ARG_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  # Other projects include its headers, and their compiler may default to an older C++.
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} trk_bridge_options)
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN")
  if(NOT ARG_PLUGIN)
    set_target_properties(${name} PROPERTIES
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  endif()
  set(export)
  if(ARG_EXPORT_AS)
    add_library(trk_bridge::${ARG_EXPORT_AS} ALIAS ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${ARG_EXPORT_AS})
    set(export EXPORT trk_bridge)
  endif()
  if(TRK_BRIDGE_LIBRARY_TYPE STREQUAL SHARED)
    install(TARGETS ${name} ${export}
      LIBRARY DESTINATION ${TRK_BRIDGE_LIB_DIR} ARCHIVE DESTINATION ${TRK_BRIDGE_LIB_DIR}
      INCLUDES DESTINATION ${TRK_BRIDGE_INCLUDE_DIR})
  endif()
endfunction()

# trk_bridge_program(NAME SOURCE... [LIBS LIB...]): an installed program.
function(trk_bridge_program name)
  cmake_parse_arguments(ARG "" "" "LIBS" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} trk_bridge_options)
  # Installed programs find their libraries wherever the installation is.
  file(RELATIVE_PATH to_libraries "/${TRK_BRIDGE_TOOL_DIR}" "/${TRK_BRIDGE_LIB_DIR}")
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
  install(TARGETS ${name} RUNTIME DESTINATION ${TRK_BRIDGE_TOOL_DIR})
endfunction()

# trk_bridge_gtest(NAME SOURCE... [LIBS LIB...]): a unit test, run by ctest and, with ROS, by catkin's run_tests.
function(trk_bridge_gtest name)
  cmake_parse_arguments(ARG "" "" "LIBS" ${ARGN})
  if(TRK_BRIDGE_ROS)
    catkin_add_gmock(${name} ${ARG_UNPARSED_ARGUMENTS})
    # gmock_main needs gmock, and archives are searched in order.
    target_link_libraries(${name} ${ARG_LIBS} trk_bridge_options trk_bridge_test_support
      ${GMOCK_MAIN_LIBRARIES} ${GMOCK_LIBRARIES})
  else()
    add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
    target_link_libraries(${name} ${ARG_LIBS} trk_bridge_options trk_bridge_test_support GTest::gmock_main)
    add_test(NAME ${name} COMMAND ${name})
  endif()
  target_precompile_headers(${name} REUSE_FROM trk_bridge_test_headers)
endfunction()
