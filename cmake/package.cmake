# What is installed: the library with its public headers and CMake and pkg-config files, the program, weights, settings,
# man pages and completions. Another project takes the library by
#   find_package(stdc_slam)            after `cmake --install`, or
#   add_subdirectory / FetchContent    of this folder,
# and links stdc_slam::stdc_slam. BUILD_SHARED_LIBS chooses between libstdc_slam.so and libstdc_slam.a.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The headers that users include. Those that these include are installed with them, and no others.
set(STDC_PUBLIC_HEADERS
  stdc_slam.hpp
  slam/slam.hpp slam/settings_io.hpp slam/make_segmenter.hpp
  input/open_source.hpp input/frame_decoder.hpp input/camera_file.hpp input/tum_calibration.hpp input/trajectory.hpp
  input/ground_truth.hpp
  features/extractor.hpp segmentation/segmenter.hpp
  dense/export/mesh_files.hpp evaluation/trajectory_error.hpp viewer/view_server.hpp)

# The headers of a list with all that they include, relative to src/.
function(stdc_with_included result)
  set(pending ${ARGN})
  set(all "")
  while(pending)
    list(POP_FRONT pending header)
    if(header IN_LIST all)
      continue()
    endif()
    list(APPEND all ${header})
    file(STRINGS ${PROJECT_SOURCE_DIR}/src/${header} lines REGEX "^#include \"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included ${line})
      list(APPEND pending ${included})
    endforeach()
  endwhile()
  set(${result} ${all} PARENT_SCOPE)
endfunction()

# One library of the objects of all layers.
set(layers core features estimation segmentation input evaluation atlas place_recognition tracking mapping loop_closing
  motion dense slam viewer)
add_library(stdc_slam_package)
add_library(stdc_slam::stdc_slam ALIAS stdc_slam_package)
set_target_properties(stdc_slam_package PROPERTIES OUTPUT_NAME stdc_slam EXPORT_NAME stdc_slam LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_compile_features(stdc_slam_package PUBLIC cxx_std_20)
target_include_directories(stdc_slam_package PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stdc_slam>)
target_include_directories(stdc_slam_package SYSTEM PUBLIC $<BUILD_INTERFACE:${OpenCV_INCLUDE_DIRS}>)
target_link_libraries(stdc_slam_package PUBLIC Eigen3::Eigen Threads::Threads $<BUILD_INTERFACE:opencv_core>)
foreach(layer IN LISTS layers)
  target_sources(stdc_slam_package PRIVATE $<TARGET_OBJECTS:stdc_${layer}>)
  get_target_property(needed stdc_${layer} LINK_LIBRARIES)
  foreach(library IN LISTS needed)
    if(NOT library MATCHES "^stdc_|^\\$|::@|opencv_core$")
      list(APPEND STDC_PRIVATE_LIBRARIES ${library})
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES STDC_PRIVATE_LIBRARIES)
target_link_libraries(stdc_slam_package PRIVATE ${STDC_PRIVATE_LIBRARIES})

# An archive holds only this project's code: who links it needs the libraries that the layers use. This gives what
# finds them again: packages for CMake's file, names of files for pkg-config's.
function(stdc_describe_private_libraries packages_name files_name)
  set(packages "")
  set(files "")
  foreach(library IN LISTS STDC_PRIVATE_LIBRARIES)
    if(NOT TARGET ${library})
      string(REGEX REPLACE "^([a-z].*)$" "-l\\1" library ${library})
      string(APPEND files " ${library}")
      continue()
    endif()
    get_target_property(kind ${library} TYPE)
    if(NOT kind STREQUAL "INTERFACE_LIBRARY")  # those have headers alone
      string(APPEND files " $<TARGET_LINKER_FILE:${library}>")
    endif()
    if(NOT library MATCHES "^opencv_")
      string(REGEX REPLACE "^SQLite::|^DNNL::|::.*$" "" package ${library})  # the name before ::, but for these two
      string(APPEND packages "find_dependency(${package})\n")
    endif()
  endforeach()
  set(${packages_name} "${packages}" PARENT_SCOPE)
  set(${files_name} "${files}" PARENT_SCOPE)
endfunction()
set(STDC_STATIC_PACKAGES "")
set(STDC_STATIC_LIBRARIES "")
if(NOT BUILD_SHARED_LIBS)
  stdc_describe_private_libraries(STDC_STATIC_PACKAGES STDC_STATIC_LIBRARIES)
endif()

if(NOT STDC_INSTALL)
  set_target_properties(stdc_slam_package PROPERTIES EXCLUDE_FROM_ALL ON)
  if(NOT STDC_BUILD_PROGRAM)
    set_target_properties(stdc_viewer PROPERTIES EXCLUDE_FROM_ALL ON)  # the Python module has no part of it
  endif()
  return()
endif()

# --- library ---
set(STDC_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/stdc_slam)
install(TARGETS stdc_slam_package EXPORT stdc_slam
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT dev
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
stdc_with_included(headers ${STDC_PUBLIC_HEADERS})
list(JOIN headers "\n" lines)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/public-headers.txt "${lines}\n")  # for scripts/api_docs
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stdc_slam/${folder}
    COMPONENT dev)
endforeach()
install(EXPORT stdc_slam NAMESPACE stdc_slam:: FILE stdc_slam-targets.cmake DESTINATION ${STDC_CMAKE_FOLDER}
  COMPONENT dev)
configure_package_config_file(cmake/stdc_slam-config.cmake.in stdc_slam-config.cmake
  INSTALL_DESTINATION ${STDC_CMAKE_FOLDER})
write_basic_package_version_file(stdc_slam-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/stdc_slam-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/stdc_slam-config-version.cmake cmake/opencv.cmake
  DESTINATION ${STDC_CMAKE_FOLDER} COMPONENT dev)
list(GET OpenCV_INCLUDE_DIRS 0 STDC_OPENCV_INCLUDE)
file(RELATIVE_PATH STDC_PREFIX_FROM_PKGCONFIG ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/stdc_slam.pc.in stdc_slam.pc.in @ONLY)
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/stdc_slam.pc INPUT ${CMAKE_CURRENT_BINARY_DIR}/stdc_slam.pc.in)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/stdc_slam.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

# --- program ---
install(TARGETS stdc-slam RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY settings/ DESTINATION ${CMAKE_INSTALL_DATADIR}/stdc-slam/settings COMPONENT program
  FILES_MATCHING PATTERN "*.yaml")
install(DIRECTORY models/ DESTINATION ${CMAKE_INSTALL_DATADIR}/stdc-slam/models COMPONENT models
  FILES_MATCHING PATTERN "*.safetensors" PATTERN "README.md")
install(FILES packaging/completions/stdc-slam.bash RENAME stdc-slam
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES packaging/completions/_stdc-slam DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
  COMPONENT program)
install(FILES packaging/completions/stdc-slam.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT program)
add_custom_command(OUTPUT man/made
  COMMAND ${PROJECT_SOURCE_DIR}/packaging/make_man $<TARGET_FILE:stdc-slam> ${PROJECT_VERSION} man
  COMMAND ${CMAKE_COMMAND} -E touch man/made
  DEPENDS stdc-slam packaging/make_man COMMENT "Making the man pages of --help" VERBATIM)
add_custom_target(man DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/man/made)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target man COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT program)
install(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program
  FILES_MATCHING PATTERN "*.1.gz")
