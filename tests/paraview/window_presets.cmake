# SPDX-License-Identifier: BSD-3-Clause
# cmake -DRUN=... -DSCRIPT=... -DNOTES_SCRIPT=... -DFOLDER=... -P window_presets.cmake: plays SCRIPT, which chooses presets, in the ParaView
# window. The filters have to take that of the bundle, and one whose values are changed by hand is no preset.
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
set(ENV{CACTUS_WINDOW_NOTES} "${FOLDER}/notes.txt")
execute_process(
  COMMAND ${RUN} --dr "--test-directory=${FOLDER}" "--script=${NOTES_SCRIPT}" "--test-script=${SCRIPT}" --exit
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 100)
string(REPLACE "ERR|" "error:" output "${output}") # which is how a test is known to have failed
file(READ "${FOLDER}/notes.txt" notes)
if (NOT result EQUAL 0 OR output MATCHES "error:")
  message(FATAL_ERROR "the window reported a failure (${result}):\n${output}\n${notes}")
endif ()
foreach (wanted IN ITEMS
    "BundleInitializer [1-9][0-9]*\nBundleInitializer has Corpus callosum, in-vivo-like\n"
    "FibreRadialGrowth [1-9][0-9]*\nFibreRadialGrowth has Corpus callosum, in-vivo-like\n"
    "BundleInitializer [1-9][0-9]*\nBundleInitializer has None\n$")
  if (NOT notes MATCHES "${wanted}")
    message(FATAL_ERROR "this is missing: ${wanted}in\n${notes}\n${output}")
  endif ()
endforeach ()
