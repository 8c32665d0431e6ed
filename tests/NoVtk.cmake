# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=... -P NoVtk.cmake: fails where a file in FOLDER includes VTK or ParaView.
file(GLOB_RECURSE files "${FOLDER}/*.h" "${FOLDER}/*.cpp")
list(LENGTH files count)
if (count EQUAL 0)
  message(FATAL_ERROR "there are no sources in ${FOLDER}")
endif ()
foreach (file IN LISTS files)
  file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*/)?(vtk|pq)")
  if (includes)
    message(SEND_ERROR "${file} includes VTK: ${includes}")
  endif ()
endforeach ()
