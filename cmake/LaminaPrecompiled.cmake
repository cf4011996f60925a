# Headers that are read once for all files instead of once for each: those of the
# C++ library and of packages that many files include, none of ours. Parsing them
# is most of what compiling a file takes. Each file still includes what it uses:
# the preset `tidy` builds without any of this, and so does a build by ccache,
# which keeps whole objects and recognises them best without.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# Not <filesystem>, CLI11 and nlohmann's json: they leave templates that are made
# anew in every file that reads them, 0.1 to 1.1 s each.
set(precompiled_headers
  <algorithm> <array> <charconv> <cmath> <cstdint> <cstring> <functional>
  <iterator> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <set>
  <span> <sstream> <string> <string_view> <tuple> <unordered_map> <utility>
  <variant> <vector>
  <fmt/format.h> <glm/common.hpp> <glm/geometric.hpp> <glm/matrix.hpp>)

# The compiler reads such headers only with the options and the definitions with
# which they were compiled, so there are three kinds: `common`, `checked` (with
# LAMINA_CHECKED_CONTAINERS) and `tests` (with GoogleTest).
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
foreach(kind IN ITEMS common checked tests)
  if(kind STREQUAL "tests" AND NOT BUILD_TESTING)
    continue()
  endif()
  add_library(lamina_precompiled_${kind} OBJECT EXCLUDE_FROM_ALL
              ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(lamina_precompiled_${kind} PRIVATE
    lamina_options fmt::fmt glm::glm)
  target_precompile_headers(lamina_precompiled_${kind}
                            PRIVATE ${precompiled_headers})
  if(NOT kind STREQUAL "tests")  # as lamina_add_library() compiles
    set_target_properties(lamina_precompiled_${kind}
                          PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
endforeach()
target_compile_definitions(lamina_precompiled_checked
                           PRIVATE ${LAMINA_CHECKED_CONTAINERS})
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  target_link_libraries(lamina_precompiled_tests PRIVATE GTest::gtest)
  target_compile_options(lamina_precompiled_tests PRIVATE ${LAMINA_TEST_OPTIONS})
  target_precompile_headers(lamina_precompiled_tests PRIVATE
    <random> <gtest/gtest.h>)
endif()

# lamina_use_precompiled(<target> <kind>)
function(lamina_use_precompiled target kind)
  target_link_libraries(${target} PRIVATE fmt::fmt)
  target_precompile_headers(${target} REUSE_FROM lamina_precompiled_${kind})
endfunction()
