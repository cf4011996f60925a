# How every target of lamina is built: one place for language level, warnings
# and floating-point rules.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
include(LaminaHardening)

# With CMAKE_UNITY_BUILD a room is compiled as one file, which reads its headers
# once: a build from nothing takes two thirds of its time. So names in unnamed
# namespaces are unique in a room. ccache keeps single files.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_UNITY_BUILD OFF)
endif()

# Options shared by all of lamina's own targets.
add_library(lamina_options INTERFACE)
target_compile_features(lamina_options INTERFACE cxx_std_20)
target_compile_options(lamina_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
  # Contraction would let one formula give two values in two places; the
  # samplers rely on equal bits for equal expressions.
  -ffp-contract=off
  # g++ takes the files of a room that is compiled as one for headers.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wno-subobject-linkage>
  # In what Python loads, no other library may put functions in the place of ours, so
  # that calls stay as direct as in a program. (A module may stand in for others.)
  $<$<AND:$<BOOL:$<TARGET_PROPERTY:POSITION_INDEPENDENT_CODE>>,$<NOT:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,MODULE_LIBRARY>>>:-fno-semantic-interposition>
  # What g++ 12 says of its own library once it has inlined it, where nothing is
  # wrong; the sanitizers and valgrind look for such mistakes themselves.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-maybe-uninitialized;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>)
target_include_directories(lamina_options INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(lamina_options INTERFACE lamina_hardening)
set(CMAKE_CXX_EXTENSIONS OFF)

# lamina_add_library(<name> [CHECKED] SOURCES … HEADERS … DEPENDS …)
# makes the static library lamina_<name> with the alias lamina::<name>.
# HEADERS are the folder's public headers. CHECKED libraries read what strangers
# wrote (LaminaHardening). The same objects make the program and what Python loads.
function(lamina_add_library name)
  cmake_parse_arguments(ARG "CHECKED" ""
                        "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(lamina_${name} STATIC ${ARG_SOURCES})
  add_library(lamina::${name} ALIAS lamina_${name})
  set_target_properties(lamina_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_sources(lamina_${name} PUBLIC FILE_SET HEADERS
                 BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(lamina_${name}
    PUBLIC lamina_options ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  if(ARG_CHECKED)
    target_compile_definitions(lamina_${name}
                               PRIVATE ${LAMINA_CHECKED_CONTAINERS})
    lamina_use_precompiled(lamina_${name} checked)
  else()
    lamina_use_precompiled(lamina_${name} common)
  endif()
endfunction()

# lamina_read_texts(<variable> <file>…)
# sets the variable to the texts of the files, one behind another. A change of one
# of them configures anew.
function(lamina_read_texts variable)
  set(all "")
  foreach(file IN LISTS ARGN)
    file(READ ${file} text)
    string(APPEND all "${text}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
                 ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

# lamina_add_test(<name> LABEL <label> SOURCES … DEPENDS …)
# makes a GoogleTest program whose cases ctest runs one by one. Its own files are
# optimised little: it runs what the libraries do, and compiles in half the time.
set(LAMINA_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
function(lamina_add_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE lamina_options ${ARG_DEPENDS}
                                        GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${LAMINA_TEST_OPTIONS})
  lamina_use_precompiled(${name} tests)
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL}
                       DISCOVERY_TIMEOUT 60)
endfunction()
