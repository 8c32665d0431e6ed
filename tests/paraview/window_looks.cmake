# SPDX-License-Identifier: BSD-3-Clause
# read_proxies(): `proxies` are those of the saved state FOLDER/window.pvsm, each from its "<Proxy group=" on, and `state` all of it.
macro (read_proxies)
  file(READ "${FOLDER}/window.pvsm" state)
  string(REGEX REPLACE "[][;]" "" state "${state}")
  string(REPLACE "<Proxy group=" ";<Proxy group=" proxies "${state}")
endmacro ()

# read_looks(): `found` is what the saved state shows, a line for each representation, table of colours and box: its type,
# and what it says of colours.
macro (read_looks)
  read_proxies()
  set(found)
  foreach (proxy IN LISTS proxies)
    if (proxy MATCHES "^<Proxy group=\"(representations|annotations|lookup_tables)\" type=\"([A-Za-z]+)\"")
      set(look "${CMAKE_MATCH_2}")
      foreach (name IN ITEMS ColorArrayName Representation RGBPoints GridAxesVisibility IndexedLookup)
        if (proxy MATCHES "<Property name=\"${name}\"[^>]*>(([^P]|P[^r])*)")
          string(REGEX MATCHALL "value=\"[^\"]*\"" values "${CMAKE_MATCH_1}")
          string(REGEX REPLACE "value=\"([^\"]*)\";*" " \\1" values "${values}")
          string(APPEND look " |${values}")
        endif ()
      endforeach ()
      list(APPEND found "${look}")
    endif ()
  endforeach ()
  list(JOIN found "\n" found)
endmacro ()

# want(PATTERN...): each has to match.
function (want)
  foreach (wanted IN LISTS ARGN)
    if (NOT found MATCHES "${wanted}")
      message(FATAL_ERROR "the view has no ${wanted}, but\n${found}")
    endif ()
  endforeach ()
endfunction ()
