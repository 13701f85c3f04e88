# Installs to an empty place and builds and runs programs of another project that finds the package there.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    file(REMOVE_RECURSE ${PLACE})
    message(FATAL_ERROR "${ARGN}\ngave ${result}:\n${output}")
  endif()
endfunction()

# Outside of the sources: rospack would take an installation in there for another package of the same name.
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE PLACE OUTPUT_STRIP_TRAILING_WHITESPACE)
set(PREFIX ${PLACE}/prefix)
set(CONSUMER_BUILD ${PLACE}/build)
unset(ENV{DESTDIR})
run(${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${PREFIX} -P ${BUILD}/cmake_install.cmake)
# The libraries are found where they are, not where they were put first.
file(RENAME ${PREFIX} ${PREFIX}_moved)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${CONSUMER_BUILD} -G ${GENERATOR}
  -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  -DCMAKE_PREFIX_PATH=${PREFIX}_moved -DWITH_ROS=${WITH_ROS} -DPYTHON_EXECUTABLE=${PYTHON})
run(${CMAKE_COMMAND} --build ${CONSUMER_BUILD})
run(${CONSUMER_BUILD}/converts)
run(${CONSUMER_BUILD}/opens)
run(${CONSUMER_BUILD}/reads_in_c)
run(${CONSUMER_BUILD}/reads_identified_in_c)
file(REMOVE_RECURSE ${PLACE})
