# A room is one folder of src/ and one library. Its headers are reached as "room/header.h" through a link folder of its own,
# which only the rooms that link it can see: an include that runs against the arrows does not build.

add_library(bookspin_warnings INTERFACE)
target_compile_options(bookspin_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(CMAKE_UNITY_BUILD)  # one file includes the others: g++ takes their anonymous names for those of headers
  target_compile_options(bookspin_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

function(bookspin_expose room)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/rooms/${room})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${room} ${PROJECT_BINARY_DIR}/rooms/${room}/${room} SYMBOLIC)
endfunction()

# bookspin_room(dynamics SOURCES a.cpp ... LINKS public libraries ... PRIVATE_LINKS hidden libraries ...)
function(bookspin_room room)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  bookspin_expose(${room})
  add_library(bookspin_${room} STATIC ${ROOM_SOURCES})
  target_include_directories(bookspin_${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/rooms/${room}>)
  target_link_libraries(bookspin_${room} PUBLIC ${ROOM_LINKS} PRIVATE $<BUILD_INTERFACE:bookspin_warnings> ${ROOM_PRIVATE_LINKS})
endfunction()

# bookspin_test(dynamics SOURCES a_test.cpp ... LINKS rooms ...): one test program a room, tests/<room>/.
function(bookspin_test room)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${room}_tests ${ROOM_SOURCES})
  target_include_directories(${room}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${room}_tests PRIVATE bookspin_warnings ${ROOM_LINKS} GTest::gtest GTest::gmock)
  target_compile_definitions(${room}_tests PRIVATE
    BOOKSPIN_SOURCE_DIR="${PROJECT_SOURCE_DIR}" BOOKSPIN_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set_target_properties(${room}_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${room} COMMAND ${room}_tests)
  # CTest's own limit of 1500 s is near for the films under sanitizers on a machine that has much else to do.
  set_tests_properties(${room} PROPERTIES TIMEOUT 7200
    ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp")
endfunction()
