# How every target of lamina is built: one place for language level, warnings
# and floating-point rules.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
include(LaminaHardening)

# Options shared by all of lamina's own targets.
add_library(lamina_options INTERFACE)
target_compile_features(lamina_options INTERFACE cxx_std_20)
target_compile_options(lamina_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
  # Contraction would let one formula give two values in two places; the
  # samplers rely on equal bits for equal expressions.
  -ffp-contract=off)
target_include_directories(lamina_options INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(lamina_options INTERFACE lamina_hardening)
set(CMAKE_CXX_EXTENSIONS OFF)

# lamina_add_library(<name> SOURCES … HEADERS … DEPENDS …)
# makes the static library lamina_<name> with the alias lamina::<name>.
# HEADERS are the folder's public headers.
function(lamina_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS"
                        ${ARGN})
  add_library(lamina_${name} STATIC ${ARG_SOURCES})
  add_library(lamina::${name} ALIAS lamina_${name})
  target_sources(lamina_${name} PUBLIC FILE_SET HEADERS
                 BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(lamina_${name}
    PUBLIC lamina_options ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
endfunction()

# lamina_add_test(<name> LABEL <label> SOURCES … DEPENDS …)
# makes a GoogleTest program whose cases ctest runs one by one.
function(lamina_add_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE lamina_options ${ARG_DEPENDS}
                                        GTest::gtest_main)
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL}
                       DISCOVERY_TIMEOUT 60)
endfunction()
