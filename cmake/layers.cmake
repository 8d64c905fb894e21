# stdc_options: what a target needs that uses the project's headers. The standard is a feature of it, so that a project
# that takes this one by add_subdirectory and links a layer need not set it.
add_library(stdc_options INTERFACE)
target_compile_features(stdc_options INTERFACE cxx_std_20)
target_include_directories(stdc_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_include_directories(stdc_options SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(stdc_options INTERFACE Eigen3::Eigen Threads::Threads)
# The project's own code is compiled strictly; who uses it need not be. No fused multiply-add: a frame gives the same
# bytes whichever instruction set the loop was dispatched to.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 17)
  add_compile_options(-Wno-deprecated-declarations)  # std::stable_sort of libstdc++ 12 uses what C++17 deprecates
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  # NEON alone: vectors of SVE have no size, so there are no arrays of them. Eigen is not to fuse either.
  add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  add_compile_options(-U__ARM_FEATURE_FMA)
endif()
if(STDC_SANITIZE)
  target_compile_options(stdc_options INTERFACE -fsanitize=${STDC_SANITIZE} -fno-omit-frame-pointer -g1
    -fno-sanitize-recover=all)
  target_link_options(stdc_options INTERFACE -fsanitize=${STDC_SANITIZE})
endif()

# How many files of a folder are compiled together at most: enough to save most of what can be saved, few enough that two
# cores share the last of them.
set(STDC_UNITED_FILES 12)
set(STDC_UNITED_TESTS 6)

# Tests are compiled with little optimisation: more costs twice the compile time and gains little.
set(STDC_TEST_OPTIONS "$<$<CONFIG:Release>:-O1>")
if(CMAKE_POSITION_INDEPENDENT_CODE)
  # CMake would say -fPIE for programs, and their precompiled headers are those of the libraries of helpers.
  list(APPEND STDC_TEST_OPTIONS -fPIC)
endif()

# Takes the tests that need rendered frames, which they include, off a list if the renderer is not built.
function(stdc_leave_out_rendered_tests list_name)
  if(STDC_BUILD_SIMULATION)
    return()
  endif()
  set(kept "")
  set(left_out "")
  foreach(file IN LISTS ${list_name})
    file(STRINGS ${file} includes REGEX "#include \"(simulation/|slam/system_tests/test_sequence|slam/system_tests/test_walk)")
    if(includes)
      get_filename_component(name ${file} NAME)
      list(APPEND left_out ${name})
    else()
      list(APPEND kept ${file})
    endif()
  endforeach()
  if(left_out)
    list(JOIN left_out ", " names)
    message(STATUS "Left out without the renderer (STDC_BUILD_SIMULATION=OFF): ${names}")
  endif()
  set(${list_name} ${kept} PARENT_SCOPE)
endfunction()

# stdc_unite(TARGET MAX file...): files of the target are compiled together in the order of their names, which keeps those
# of a folder together, at most MAX of them: what their headers and templates cost is paid once, which halves a whole
# build. A change to one compiles its neighbours too, so who works on the code turns STDC_UNITY off. Names in their
# anonymous namespaces must differ. Files that Highway compiles once for each instruction set stay alone, and so do those
# with options of their own.
function(stdc_unite target max)
  if(NOT STDC_UNITY)
    return()
  endif()
  set(count 0)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} alone REGEX "hwy/foreach_target|UNITY: alone")
    if(alone)
      continue()
    endif()
    math(EXPR group "${count} / ${max}")
    math(EXPR count "${count} + 1")
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${target}_${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # For Clang a local name shadows that of another file; where each is compiled alone (scripts/lint) it looks for real ones.
    target_compile_options(${target} PRIVATE -Wno-shadow)
  endif()
endfunction()

# stdc_add_layer(NAME DEPENDS target... TEST_DEPENDS target...)
# Makes the library stdc_NAME of the .cpp files in this folder and its sub-folders, and the test program
# stdc_NAME_test of the *_test.cpp files. Helpers of tests and benchmarks, test_*.cpp, are the library
# stdc_NAME_testing: they are compiled once, and tests of higher layers name that library under TEST_DEPENDS.
# ONE_TEST: CTest runs the program as a whole, for tests that share something expensive.
function(stdc_add_layer name)
  cmake_parse_arguments(LAYER "ONE_TEST" "" "DEPENDS;TEST_DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  set(tests ${sources})
  set(helpers ${sources})
  list(FILTER sources EXCLUDE REGEX "(_test|/test_[^/]*)\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER helpers INCLUDE REGEX "/test_[^/]*\\.cpp$")
  stdc_leave_out_rendered_tests(tests)
  stdc_leave_out_rendered_tests(helpers)
  foreach(library IN LISTS LAYER_TEST_DEPENDS)
    if(library MATCHES "_testing$" AND NOT TARGET ${library})
      list(REMOVE_ITEM LAYER_TEST_DEPENDS ${library})  # all of it was left out
    endif()
  endforeach()
  if(sources)
    add_library(stdc_${name} STATIC ${sources})
    target_link_libraries(stdc_${name} PUBLIC stdc_options ${LAYER_DEPENDS})
    stdc_use_precompiled(stdc_${name} stdc_precompiled)
    stdc_unite(stdc_${name} ${STDC_UNITED_FILES} ${sources})
  else()
    add_library(stdc_${name} INTERFACE)
    target_link_libraries(stdc_${name} INTERFACE stdc_options ${LAYER_DEPENDS})
  endif()
  if(helpers)
    stdc_add_test_helpers(stdc_${name}_testing DEPENDS stdc_${name} ${LAYER_TEST_DEPENDS} SOURCES ${helpers})
    list(PREPEND LAYER_TEST_DEPENDS stdc_${name}_testing)
  endif()
  if(STDC_BUILD_TESTS AND tests)
    add_executable(stdc_${name}_test ${tests})
    target_link_libraries(stdc_${name}_test PRIVATE ${LAYER_TEST_DEPENDS} stdc_${name} GTest::gtest_main)
    target_compile_options(stdc_${name}_test PRIVATE ${STDC_TEST_OPTIONS})
    stdc_use_precompiled(stdc_${name}_test stdc_test_precompiled)
    stdc_unite(stdc_${name}_test ${STDC_UNITED_TESTS} ${tests})
    if(LAYER_ONE_TEST)
      add_test(NAME ${name} COMMAND stdc_${name}_test)
    else()
      gtest_discover_tests(stdc_${name}_test DISCOVERY_TIMEOUT 120)
    endif()
  endif()
endfunction()

# stdc_add_test_helpers(TARGET DEPENDS target... SOURCES file...): a library of test helpers. Benchmarks and fuzzers use
# some of them, so it is there without the tests too, and built when something links it.
function(stdc_add_test_helpers target)
  cmake_parse_arguments(HELPERS "" "" "DEPENDS;SOURCES" ${ARGN})
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${HELPERS_SOURCES})
  target_link_libraries(${target} PUBLIC ${HELPERS_DEPENDS})
  target_compile_options(${target} PRIVATE ${STDC_TEST_OPTIONS})
  if(STDC_BUILD_TESTS)
    target_link_libraries(${target} PUBLIC GTest::gtest)
    stdc_use_precompiled(${target} stdc_test_precompiled)
  endif()
endfunction()
