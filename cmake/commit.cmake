# cmake -DSOURCE=checkout -DHEADER=file -P commit.cmake: writes the header, if it would change, with the last commit that
# touched what the program is built from, and a plus when there are changes since. Empty outside a checkout.
cmake_minimum_required(VERSION 3.25)
set(commit "")
if(EXISTS ${SOURCE}/.git)
  set(parts -- src cmake CMakeLists.txt)
  execute_process(COMMAND git -C ${SOURCE} log -1 --abbrev=12 --format=%h ${parts}
    OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND git -C ${SOURCE} status --porcelain -uno ${parts} OUTPUT_VARIABLE changes ERROR_QUIET)
  if(commit AND changes)
    string(APPEND commit "+")
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define BOOKSPIN_COMMIT \"@commit@\"\n" @ONLY)
