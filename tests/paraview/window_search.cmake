# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DXML_FOLDER=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_search.cmake: plays SCRIPT, with as many filters
# as XML_FOLDER puts into the menus, in the ParaView window. By "cactus" the search has to find all of them, and to make those chosen.
file(GLOB described "${XML_FOLDER}/*.xml")
set(filters 0)
foreach (file IN LISTS described)
  file(STRINGS "${file}" shown REGEX "<ShowInMenu ")
  list(LENGTH shown count)
  math(EXPR filters "${filters} + ${count}")
endforeach ()
math(EXPR others "${filters} - 1") # than the one that needs no input
set(script "${FOLDER}.xml")
configure_file("${SCRIPT}" "${script}" @ONLY)
set(SCRIPT "${script}")

include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
if (output MATCHES "error:")
  message(FATAL_ERROR "the window reported an error:\n${output}\n${notes}")
endif ()
if (NOT notes MATCHES "^BundleInitializer [1-9][^/]*\nCapsuleOptimizer [1-9][0-9]*\n")
  message(FATAL_ERROR "a bundle, and then its optimised fibres, were expected:\n${notes}\n${output}")
endif ()
