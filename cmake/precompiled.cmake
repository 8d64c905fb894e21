# Headers that nearly every file needs and that cost seconds to read are compiled once: for the libraries, and for the
# tests. Measured on this project they are more than half of what a file costs.
option(STDC_PRECOMPILED "Compile the heavy headers once" ON)
set(STDC_HEAVY_HEADERS <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span> <string>
  <vector> <Eigen/Core> <Eigen/Dense> <fmt/format.h> <opencv2/core.hpp>)

function(stdc_make_precompiled name)
  cmake_parse_arguments(PCH "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp.in "// Carries the precompiled headers.\n")
  configure_file(${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp COPYONLY)
  add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE stdc_options fmt::fmt ${PCH_LIBRARIES})
  target_compile_options(${name} PRIVATE ${PCH_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${PCH_HEADERS})
endfunction()

# stdc_use_precompiled(TARGET CARRIER): the target takes the headers of stdc_precompiled or of another carrier.
function(stdc_use_precompiled target carrier)
  if(STDC_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${carrier})
  endif()
endfunction()

if(STDC_PRECOMPILED)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)  # without it ccache cannot see into them
  endif()
  stdc_make_precompiled(stdc_precompiled HEADERS ${STDC_HEAVY_HEADERS})
  if(STDC_BUILD_TESTS)
    stdc_make_precompiled(stdc_test_precompiled HEADERS ${STDC_HEAVY_HEADERS} <gtest/gtest.h>
      OPTIONS ${STDC_TEST_OPTIONS} LIBRARIES GTest::gtest)
  endif()
endif()
