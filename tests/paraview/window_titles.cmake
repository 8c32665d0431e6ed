# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_titles.cmake: the window runs NOTES_SCRIPT and plays SCRIPT. The state,
# saved at the end, has the title of the colour bar.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
file(READ "${FOLDER}/window.pvsm" state)
if (NOT state MATCHES "value=\"Radius \\(µm\\)\"" OR state MATCHES "Â")
  message(FATAL_ERROR "the colour bar's title is not \"Radius (µm)\"")
endif ()
