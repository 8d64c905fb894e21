# stdc_options: what every target of the project is compiled with.
add_library(stdc_options INTERFACE)
target_include_directories(stdc_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_include_directories(stdc_options SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
# No fused multiply-add: a frame gives the same bytes whichever instruction set the loop was dispatched to.
target_compile_options(stdc_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  -Woverloaded-virtual -Werror -ffp-contract=off)
target_link_libraries(stdc_options INTERFACE Eigen3::Eigen Threads::Threads)
if(STDC_SANITIZE)
  target_compile_options(stdc_options INTERFACE -fsanitize=${STDC_SANITIZE} -fno-omit-frame-pointer -g
    -fno-sanitize-recover=all)
  target_link_options(stdc_options INTERFACE -fsanitize=${STDC_SANITIZE})
endif()

# Tests are compiled with little optimisation: they cost twice the time otherwise and gain next to nothing.
set(STDC_TEST_OPTIONS "$<$<CONFIG:Release>:-O1>")

# stdc_add_layer(NAME DEPENDS target...)
# Makes the library stdc_NAME of the .cpp files in this folder and its sub-folders, and the test program
# stdc_NAME_test of the *_test.cpp files. ONE_TEST: CTest runs the program as a whole, for tests that share something
# expensive.
function(stdc_add_layer name)
  cmake_parse_arguments(LAYER "ONE_TEST" "" "DEPENDS;TEST_DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  if(sources)
    add_library(stdc_${name} STATIC ${sources})
    target_link_libraries(stdc_${name} PUBLIC stdc_options ${LAYER_DEPENDS})
    stdc_use_precompiled(stdc_${name} stdc_precompiled)
  else()
    add_library(stdc_${name} INTERFACE)
    target_link_libraries(stdc_${name} INTERFACE stdc_options ${LAYER_DEPENDS})
  endif()
  if(STDC_BUILD_TESTS AND tests)
    add_executable(stdc_${name}_test ${tests})
    target_link_libraries(stdc_${name}_test PRIVATE stdc_${name} ${LAYER_TEST_DEPENDS} GTest::gtest_main)
    target_compile_options(stdc_${name}_test PRIVATE ${STDC_TEST_OPTIONS})
    stdc_use_precompiled(stdc_${name}_test stdc_test_precompiled)
    if(LAYER_ONE_TEST)
      add_test(NAME ${name} COMMAND stdc_${name}_test)
    else()
      gtest_discover_tests(stdc_${name}_test DISCOVERY_TIMEOUT 120)
    endif()
  endif()
endfunction()
