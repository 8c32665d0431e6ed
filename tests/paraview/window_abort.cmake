# SPDX-License-Identifier: BSD-3-Clause
# cmake -DHOW=... -DRUN=... -DPYTHON=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_abort.cmake: plays SCRIPT in the ParaView window,
# while somebody else clicks on the abort button (HOW stop) or closes the window (HOW close) as soon as growth works. A message has to say that growth
# was stopped; the next Apply has to grow, or the window has to close.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
set(RUN "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/window_click.py" "${HOW}" "${RUN}")
play()
if (NOT output MATCHES "stopped by the user, and nothing is kept")
  message(FATAL_ERROR "a message was to say that growth was stopped:\n${output}")
endif ()
if (HOW STREQUAL "close" AND NOT output MATCHES "the window is closed")
  message(FATAL_ERROR "the window was to close:\n${output}")
elseif (HOW STREQUAL "stop" AND NOT notes MATCHES "FibreRadialGrowth 0\n.*FibreRadialGrowth [1-9]")
  message(FATAL_ERROR "growth was to give nothing where it was stopped, and an image at the next Apply:\n${notes}")
endif ()
