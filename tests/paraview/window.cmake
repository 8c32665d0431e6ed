# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window.cmake: plays SCRIPT in the ParaView window, which has to save fibres in FOLDER.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play(100)
if (NOT EXISTS "${FOLDER}/optimised.strands")
  message(FATAL_ERROR "no fibres were saved")
endif ()
file(STRINGS "${FOLDER}/optimised.strands" lines LIMIT_COUNT 2)
list(GET lines 0 side)
list(GET lines 1 fibres)
if (NOT side EQUAL 8 OR NOT fibres GREATER 10)
  message(FATAL_ERROR "a cube of 8 µm with many fibres was expected; the file says ${side} and ${fibres}")
endif ()
