# Installs to an empty folder, moves it, and hides the source and the build if private mounts are permitted. Then builds
# and runs programs of another project, which find the package with CMake and with pkg-config, and uses the installed
# files.
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
unset(ENV{DESTDIR})
run(${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${PREFIX} -P ${BUILD}/cmake_install.cmake)
# The libraries are found at their current place, not at the original one.
file(RENAME ${PREFIX} ${PREFIX}_moved)
set(PREFIX ${PREFIX}_moved)
file(COPY ${SOURCE}/test/install/ ${SOURCE}/test/data/field/takes/euler.trk DESTINATION ${PLACE}/test)
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
