# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Installs to an empty folder, moves it, and hides the source and the build if private mounts are permitted. Then builds
# and runs programs of another project, which find the package with CMake and with pkg-config, and uses the installed
# files. Checks that each of them is installed once, and is in a Debian package.
cmake_policy(VERSION 3.16)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    file(REMOVE_RECURSE ${PLACE})
    message(FATAL_ERROR "${ARGN}\ngave ${result}:\n${output}")
  endif()
endfunction()

# Outside of the sources, where rospack would find the installation as another package of the same name.
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE PLACE OUTPUT_STRIP_TRAILING_WHITESPACE)
set(PREFIX ${PLACE}/prefix)
set(CONSUMER_BUILD ${PLACE}/build)
# Not by another prefix: catkin's setup files go to the one that was configured.
set(ENV{DESTDIR} ${PLACE}/installed)
run(${CMAKE_COMMAND} -P ${BUILD}/cmake_install.cmake)
unset(ENV{DESTDIR})
# Which of two files with one name is installed would depend on their times.
file(STRINGS ${BUILD}/install_manifest.txt files)
set(installed)
foreach(name IN LISTS files)
  if(name IN_LIST installed)
    file(REMOVE_RECURSE ${PLACE})
    message(FATAL_ERROR "installed twice: ${name}")
  endif()
  list(APPEND installed ${name})
endforeach()
# The libraries are found where they are, not where they were put first.
file(RENAME ${PLACE}/installed${INSTALL_PREFIX} ${PREFIX})
file(COPY ${SOURCE}/test/install/ ${SOURCE}/test/data/field/takes/euler.trk DESTINATION ${PLACE}/test)
set(without_ros)
if(NOT WITH_ROS)
  set(without_ros --without-ros)
endif()
run(${PYTHON} -B ${SOURCE}/test/install/packages_test.py --prefix ${PREFIX} --debian ${SOURCE}/debian ${without_ros})
set(ENV{PREFIX} ${PREFIX})
set(ENV{VERSION} ${VERSION})

set(alone)
execute_process(COMMAND unshare --user --map-root-user --mount true RESULT_VARIABLE cannot_hide OUTPUT_QUIET ERROR_QUIET)
if(cannot_hide)
  message(STATUS "source and build are not hidden: this system gives no namespaces")
else()
  set(alone unshare --user --map-root-user --mount sh ${PLACE}/test/hidden.sh ${SOURCE} ${BUILD} --)
endif()
run(${alone} sh ${PLACE}/test/use.sh ${PLACE}/test)
run(${alone} ${CMAKE_COMMAND} -S ${PLACE}/test/consumer -B ${CONSUMER_BUILD} -G ${GENERATOR}
  -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DWITH_ROS=${WITH_ROS} -DPYTHON_EXECUTABLE=${PYTHON})
run(${alone} ${CMAKE_COMMAND} --build ${CONSUMER_BUILD})
run(${alone} ${CONSUMER_BUILD}/converts)
run(${alone} ${CONSUMER_BUILD}/opens)
run(${alone} ${CONSUMER_BUILD}/reads_in_c)
run(${alone} ${CONSUMER_BUILD}/reads_identified_in_c)
set(ENV{CC} ${C_COMPILER})
set(ENV{CXX} ${CXX_COMPILER})
run(${alone} sh ${PLACE}/test/pkg_config.sh ${PLACE}/test ${PLACE})
file(REMOVE_RECURSE ${PLACE})
