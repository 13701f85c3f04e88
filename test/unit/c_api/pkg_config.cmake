# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
# Installs to an empty folder and builds a C program with the flags of pkg-config, like a user does.

# Outside of the sources, where roslaunch would find the installation as another package of the same name.
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE)

function(fail text)
  file(REMOVE_RECURSE ${prefix})
  message(FATAL_ERROR "${text}")
endfunction()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    fail("${ARGN}\ngave ${result}:\n${output}")
  endif()
endfunction()

unset(ENV{DESTDIR})
run(${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${prefix} -P ${BUILD}/cmake_install.cmake)

set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIB_DIR}/pkgconfig)
set(ENV{LD_LIBRARY_PATH} ${prefix}/${LIB_DIR})
foreach(library trk trk_identified)
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs ${library}
    RESULT_VARIABLE result OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    fail("pkg-config does not find ${library}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${COMPILER} -std=c99 -Wall -Werror ${SOURCE} -o ${prefix}/user ${flags})
  run(${prefix}/user)
endforeach()
file(REMOVE_RECURSE ${prefix})
