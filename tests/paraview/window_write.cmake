# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_write.cmake: plays SCRIPT in the ParaView window, which has to write the folder that was
# named before its button was pressed, besides the one that was applied.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
foreach (name IN ITEMS written other)
  if (NOT EXISTS "${FOLDER}/${name}/manifest.json")
    message(FATAL_ERROR "${name} was not written:\n${output}")
  endif ()
endforeach ()
if (output MATCHES "error:")
  message(FATAL_ERROR "the window reported an error:\n${output}")
endif ()
