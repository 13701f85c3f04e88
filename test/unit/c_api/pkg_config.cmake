# Installs to an empty place and builds a C program with what pkg-config says of it, as a user does.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\ngave ${result}:\n${output}")
  endif()
endfunction()

set(prefix ${BUILD}/pkg_config_test)
file(REMOVE_RECURSE ${prefix})
unset(ENV{DESTDIR})
run(${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${prefix} -P ${BUILD}/cmake_install.cmake)

set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIB_DIR}/pkgconfig)
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs trk
  RESULT_VARIABLE result OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "pkg-config does not find trk")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")

run(${COMPILER} -std=c99 -Wall -Werror ${SOURCE} -o ${prefix}/user ${flags})
set(ENV{LD_LIBRARY_PATH} ${prefix}/${LIB_DIR})
run(${prefix}/user)
file(REMOVE_RECURSE ${prefix})
