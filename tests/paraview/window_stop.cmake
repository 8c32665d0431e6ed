# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_stop.cmake: plays SCRIPT, which presses Stop while the optimiser works,
# in the ParaView window. One message has to say so, the state that it tells of has to be the one shown, without advice to somebody who wanted
# just this; the next Apply has to part the fibres, and growth to take them.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
if (output MATCHES "error:")
  message(FATAL_ERROR "the window reported an error:\n${output}")
endif ()
string(REGEX MATCHALL "the run was stopped after" stops "${output}")
list(LENGTH stops count)
if (NOT count EQUAL 1 OR NOT output MATCHES "the largest penetration being ([0-9.e-]+[0-9])\\. The best state is kept\\.[^A-Z]*\n")
  message(FATAL_ERROR "one message, without advice, was to say that the run was stopped:\n${output}")
endif ()
set(kept "${CMAKE_MATCH_1}")
if (NOT notes MATCHES "CapsuleOptimizer penetration ${kept}\n(.*)")
  message(FATAL_ERROR "the state that was kept, of penetration ${kept}, was not shown:\n${notes}")
endif ()
if (NOT CMAKE_MATCH_1 MATCHES "CapsuleOptimizer penetration ([0-9.e-]+)\n" OR CMAKE_MATCH_1 GREATER 0.001)
  message(FATAL_ERROR "the next Apply did not part the fibres:\n${notes}")
endif ()
if (NOT notes MATCHES "FibreRadialGrowth [1-9]" OR output MATCHES "still overlap")
  message(FATAL_ERROR "growth did not take the fibres of the next Apply:\n${notes}\n${output}")
endif ()
