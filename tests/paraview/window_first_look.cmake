# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_first_look.cmake: plays SCRIPT in the ParaView window. Fibres of 12 µm that come after a
# slip, of 24 µm after these, and growth of 48 µm that comes after another slip, have to be seen whole, from outside, and growth in colours of its depth, as those of a first Apply are.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play(100)
file(READ "${FOLDER}/window.pvsm" state)
if (NOT state MATCHES "<Property name=\"CameraPosition\"[^>]*>[^<]*<Element index=\"0\" value=\"([-0-9.e]+)\"")
  message(FATAL_ERROR "the state has no camera")
endif ()
if (NOT CMAKE_MATCH_1 GREATER 60)
  message(FATAL_ERROR "the camera is at x = ${CMAKE_MATCH_1} µm, among the fibres or near to them")
endif ()
if (output MATCHES "Failed to locate" OR NOT state MATCHES "name=\"ColorArrayName\"[^>]*>[^P]*value=\"Depth\"")
  message(FATAL_ERROR "growth is not coloured by its depth:\n${output}")
endif ()
if (NOT state MATCHES "name=\"Representation\"[^>]*>[^P]*value=\"Slice\"")
  message(FATAL_ERROR "growth is not shown as a section")
endif ()
