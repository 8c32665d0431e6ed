# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_panels.cmake: plays SCRIPT in the ParaView window, which measures panels.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
if (output MATCHES "error:")
  message(FATAL_ERROR "the window reported an error:\n${output}")
endif ()
