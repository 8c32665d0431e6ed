# SPDX-License-Identifier: BSD-3-Clause
# For scripts of the ParaView window. play(): plays SCRIPT, and NOTES_SCRIPT beside it where there is one, in the window that RUN
# starts, with FOLDER, made anew, for its files. Then `output` is what the window said, and `notes` what NOTES_SCRIPT noted.
macro (play)
  file(REMOVE_RECURSE "${FOLDER}")
  file(MAKE_DIRECTORY "${FOLDER}")
  set(ENV{CACTUS_WINDOW_NOTES} "${FOLDER}/notes.txt")
  set(scripts "--test-script=${SCRIPT}")
  if (NOTES_SCRIPT)
    list(INSERT scripts 0 "--script=${NOTES_SCRIPT}")
  endif ()
  execute_process(
    COMMAND ${RUN} --dr "--test-directory=${FOLDER}" ${scripts} --exit
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 280) # which ends before the test does
  string(REPLACE "ERR|" "error:" output "${output}") # which is how a test is known to have failed
  if (NOT result EQUAL 0)
    message(FATAL_ERROR "the window reported a failure (${result}):\n${output}")
  endif ()
  if (EXISTS "${FOLDER}/notes.txt")
    file(READ "${FOLDER}/notes.txt" notes)
  endif ()
endmacro ()
