# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DFOLDER=... -P window_images.cmake: plays SCRIPT in the ParaView window. The state, saved at the end, has what is
# seen of the images, and in which colours.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/window_looks.cmake")
play()
read_looks()
want("ImageRepresentation[ |0]+AVF [|] Sections" "ImageRepresentation[ |0]+Field [|] Sections" "UniformGridRepresentation[ |0]+Depth"
  "UniformGridRepresentation[ |0]+Mask" "PVLookupTable [|] -[0-9.]+ 0.231 0.298 0.753 0 1 1 1 " "PVLookupTable [|] 0 0 0 0 255 1 1 1" "GridAxesRepresentation [|] 1"
  "ConvergenceChartRepresentation" "UnstructuredGridRepresentation[ |0-9]+BundleId" "PVLookupTable [^\n]* [|] 1\n")
