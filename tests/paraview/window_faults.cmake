# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_faults.cmake: plays SCRIPT, which makes a slip in each stage
# and corrects it, in the ParaView window. Each has to give one error, nothing, and then something.
include("${CMAKE_CURRENT_LIST_DIR}/window_play.cmake")
play()
foreach (stage IN ITEMS BundleInitializer FibreRadialGrowth MyelinSurface CapsuleOptimizer)
  string(REGEX MATCHALL "error: vtk${stage} " errors "${output}")
  list(LENGTH errors count)
  if (NOT count EQUAL 1)
    message(FATAL_ERROR "${stage} reported ${count} errors, not one:\n${output}")
  endif ()
  if (NOT notes MATCHES "${stage} 0\n.*${stage} [1-9]")
    message(FATAL_ERROR "${stage} did not give nothing and then something:\n${notes}\n${output}")
  endif ()
endforeach ()
