# cmake -DSOURCE=checkout -DHEADER=file -P single_header.cmake: the exact motion and what it includes, as one header. Each
# header comes before what includes it, then each .cpp, its functions inline, its own names in a namespace that has its name.
cmake_minimum_required(VERSION 3.25)
set(seen "")
set(std_includes "")
set(headers "")
set(sources "")

# Lists break at semicolons and join at brackets, of which C++ has many: text is never made into a list here.
function(take name)
  file(READ ${SOURCE}/src/${name} text)
  string(REGEX MATCHALL "#include <[^>]+>\n" found "${text}")
  list(APPEND std_includes ${found})
  string(REGEX MATCHALL "#include \"[^\"]+\"" needs "${text}")
  list(APPEND seen ${name})
  foreach(need ${needs})
    string(REGEX REPLACE "#include \"(.*)\"" "\\1" need ${need})
    if(NOT need IN_LIST seen)
      take(${need})
    endif()
  endforeach()
  string(REGEX REPLACE "#include [^\n]*\n" "" text "${text}")
  string(REPLACE "#pragma once\n" "" text "${text}")
  if(name MATCHES "\\.h$")
    string(APPEND headers "${text}")
    string(REGEX REPLACE "h$" "cpp" source ${name})
    if(EXISTS ${SOURCE}/src/${source} AND NOT source IN_LIST seen)
      take(${source})
    endif()
  else()
    string(REGEX REPLACE ".*/(.*)\\.cpp" "\\1_cpp" own ${name})
    # A definition begins a line, with a name, and has its parameters there; one that is a template or constexpr is
    # inline already.
    string(REGEX REPLACE "\n(([A-Za-z_][A-Za-z0-9_:<>, ]*[ &*])?[A-Za-z_][A-Za-z0-9_:]*\\()" "\n@inline@\\1" text "${text}")
    string(REGEX REPLACE "(>\n)@inline@" "\\1" text "${text}")
    string(REGEX REPLACE "@inline@(constexpr|inline|static_assert)" "\\1" text "${text}")
    string(REPLACE "\n[[noreturn]] " "\n[[noreturn]] inline " text "${text}")
    string(REPLACE "@inline@" "inline " text "${text}")
    string(REGEX REPLACE "\nconstexpr ([^(\n]*) = " "\ninline constexpr \\1 = " text "${text}")
    string(REPLACE "\nnamespace {\n" "\nnamespace ${own} {\n" text "${text}")
    string(REPLACE "\n}  // namespace\n" "\n}  // namespace ${own}\nusing namespace ${own};\n" text "${text}")
    string(APPEND sources "${text}")
  endif()
  foreach(variable seen std_includes headers sources)
    set(${variable} "${${variable}}" PARENT_SCOPE)
  endforeach()
endfunction()

take(dynamics/rigid_motion.h)
list(REMOVE_DUPLICATES std_includes)
list(SORT std_includes)
list(JOIN std_includes "" std_includes)
file(WRITE ${HEADER} "// The exact torque-free motion of bookspin in one header, which needs C++20 and Eigen. Made from its sources.
// Compile with -ffp-contract=off for the same bits on every machine.
#pragma once

${std_includes}
${headers}${sources}")
