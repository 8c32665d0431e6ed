# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_chain.cmake: plays SCRIPT in the ParaView window, which has to leave one chain of the
# two that are set up, each filter behind the one before.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
file(READ "${FOLDER}/window.pvsm" state)
foreach (filter IN ITEMS BundleInitializer CapsuleOptimizer FibreRadialGrowth MyelinSurface)
  string(REGEX MATCHALL "<Proxy group=\"[a-z]+\" type=\"${filter}\" id=\"[0-9]+\"" found "${state}")
  list(LENGTH found count)
  if (NOT count EQUAL 1)
    message(FATAL_ERROR "the state has ${count} of ${filter}")
  endif ()
  if (before AND NOT state MATCHES "type=\"${filter}\"[^>]*>[ \n]*(<Property[^>]*>[^P]*</Property>[ \n]*)*<Property name=\"Input\"[^>]*>[ \n]*<Proxy value=\"${before}\"")
    message(FATAL_ERROR "${filter} is not behind the filter before it")
  endif ()
  string(REGEX REPLACE ".*id=\"([0-9]+)\"" "\\1" before "${found}")
endforeach ()
