# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=... -DSTAMP=... -P HelpCharset.cmake: every page of FOLDER says that it is UTF-8, and STAMP that this has been done.
# Without it the help window takes pages for Latin-1, and shows "Âµm".
set(charset "<meta http-equiv=\"Content-Type\" content=\"text/html; charset=utf-8\"/>")
file(GLOB pages "${FOLDER}/*.html")
foreach (page IN LISTS pages)
  file(READ "${page}" text)
  if (NOT text MATCHES "charset=")
    string(REPLACE "<head>" "<head>\n        ${charset}" text "${text}")
    file(WRITE "${page}" "${text}")
  endif ()
endforeach ()
list(LENGTH pages count)
file(WRITE "${STAMP}" "${count} pages\n")
