# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_beside.cmake: plays SCRIPT in the ParaView window, which opens files that it has saved itself.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/window_looks.cmake")
play()
read_looks()
want("UniformGridRepresentation[ |0]+image [|] Slice" "FibreRepresentation [ |]+ Tubes" "PlacedRepresentation [ |]+ Placed" "AxonRepresentation [ |]+ Axons")
foreach (axis IN ITEMS X Y)
  if (NOT state MATCHES "name=\"Position${axis}\"[^>]*>[^<]*<Element index=\"0\" value=\"-?[0-9.e-]*[1-9]")
    message(FATAL_ERROR "Position${axis} is not that of the point picked")
  endif ()
endforeach ()
