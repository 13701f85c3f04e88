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

# trk_bridge_tests(MODULE TEST... [SUFFIX SUFFIX] [HEADERS TARGET] [LIBS LIB...]): the unit tests of a module: the program
# MODULE_tests of all files TEST_test.cpp, and for each file a test MODULE_TEST_test of ctest and catkin's run_tests, which
# runs only this file. One program, because the headers take most of the compile time of a test, and with
# CMAKE_UNITY_BUILD the files of a program share them; therefore each file has a namespace of its name. SUFFIX is for a
# second program of the same files, and part of all names. HEADERS is the target with the precompiled headers.
function(trk_bridge_tests module)
  cmake_parse_arguments(ARG "" "SUFFIX;HEADERS" "LIBS" ${ARGN})
  set(program ${module}${ARG_SUFFIX}_tests)
  list(TRANSFORM ARG_UNPARSED_ARGUMENTS APPEND _test.cpp OUTPUT_VARIABLE sources)
  trk_bridge_test_program(${program} ${sources} HEADERS ${ARG_HEADERS} LIBS ${ARG_LIBS})
  foreach(test ${ARG_UNPARSED_ARGUMENTS})
    trk_bridge_add_test(${module}_${test}${ARG_SUFFIX}_test ${program} ${test}_test.cpp)
  endforeach()
endfunction()

# trk_bridge_gtest(NAME SOURCE... [HEADERS TARGET] [LIBS LIB...]): a unit test that is a program of its own, because it
# replaces functions of the process or has other libraries than the tests of its module.
function(trk_bridge_gtest name)
  trk_bridge_test_program(${name} ${ARGN})
  trk_bridge_add_test(${name} ${name})
endfunction()

# trk_bridge_test_program(NAME SOURCE... [HEADERS TARGET] [LIBS LIB...]): a program of tests, with test/support/main.cpp.
function(trk_bridge_test_program name)
  cmake_parse_arguments(ARG "" "HEADERS" "LIBS" ${ARGN})
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS trk_bridge_test_headers)
  endif()
  if(TRK_BRIDGE_ROS)
    catkin_add_executable_with_gmock(${name} ${ARG_UNPARSED_ARGUMENTS} EXCLUDE_FROM_ALL)
    add_dependencies(tests ${name})
  else()
    add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  endif()
  # Archives are searched in order: main() needs GoogleMock.
  target_link_libraries(${name} ${ARG_LIBS} trk_bridge_options trk_bridge_test_support trk_bridge_test_main)
  target_precompile_headers(${name} REUSE_FROM ${ARG_HEADERS})
endfunction()

# trk_bridge_add_test(NAME PROGRAM [FILE]): a test of ctest and, with ROS, of catkin's run_tests: all tests of a program, or
# those of one of its files.
function(trk_bridge_add_test name program)
  if(TRK_BRIDGE_ROS)
    set(results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/gtest-${name}.xml)
    catkin_run_tests_target(gtest ${name} gtest-${name}.xml
      COMMAND "$<TARGET_FILE:${program}> ${ARGN} --gtest_output=xml:${results}" DEPENDENCIES ${program})
  else()
    add_test(NAME ${name} COMMAND ${program} ${ARGN})
  endif()
endfunction()
