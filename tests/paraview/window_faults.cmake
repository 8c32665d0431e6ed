# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_faults.cmake: plays SCRIPT, which makes a slip in each stage
# and corrects it, in the ParaView window. Each has to give one error, nothing, and then something.
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
set(ENV{CACTUS_WINDOW_NOTES} "${FOLDER}/notes.txt")
execute_process(
  COMMAND ${RUN} --dr "--test-directory=${FOLDER}" "--script=${NOTES_SCRIPT}" "--test-script=${SCRIPT}" --exit
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 150)
string(REPLACE "ERR|" "error:" output "${output}") # which is how a test is known to have failed
if (NOT result EQUAL 0)
  message(FATAL_ERROR "the window reported a failure (${result}):\n${output}")
endif ()
file(READ "${FOLDER}/notes.txt" notes)
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
