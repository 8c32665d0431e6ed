# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DPYTHON=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_abort.cmake: plays SCRIPT in the ParaView window, while
# somebody else clicks on the abort button as soon as growth works. A message has to say that it was stopped, and the next Apply has to grow.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
set(RUN "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/window_click.py" "${RUN}")
play()
if (NOT output MATCHES "stopped by the user, and nothing is kept")
  message(FATAL_ERROR "a message was to say that growth was stopped:\n${output}")
endif ()
if (NOT notes MATCHES "FibreRadialGrowth 0\n.*FibreRadialGrowth [1-9]")
  message(FATAL_ERROR "growth was to give nothing where it was stopped, and an image at the next Apply:\n${notes}")
endif ()
